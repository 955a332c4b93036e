#include "radiosity/patch/box_pairs.h"

#include <algorithm>

namespace lambert {
namespace {

// A part of the order, and the box around it.
struct Node {
  size_t index, begin, end;
  bool IsLeaf() const { return end - begin == 1; }
  Node Child(int k) const {
    const size_t middle = begin + (end - begin) / 2;
    return {2 * index + 1 + k, k == 0 ? begin : middle, k == 0 ? middle : end};
  }
};

class PairFinder {
 public:
  PairFinder(const std::vector<Bounds>& boxes, double slack,
             absl::FunctionRef<void(size_t, size_t)> visit)
      : boxes_(boxes), slack_(slack), visit_(visit), around_(4 * boxes.size()) {
    Build(Root());
  }
  Node Root() const { return {0, 0, boxes_.size()}; }

  void PairsInside(const Node& node) {
    if (node.IsLeaf()) return;
    const Node first = node.Child(0), second = node.Child(1);
    PairsInside(first);
    PairsInside(second);
    PairsAcross(first, second);
  }

 private:
  void Build(const Node& node) {
    if (node.IsLeaf()) {
      around_[node.index] = boxes_[node.begin];
      return;
    }
    const Node first = node.Child(0), second = node.Child(1);
    Build(first);
    Build(second);
    around_[node.index] = around_[first.index];
    around_[node.index].Add(around_[second.index]);
  }

  bool Meet(const Bounds& a, const Bounds& b) const {
    return a.low.x <= b.high.x + slack_ && b.low.x <= a.high.x + slack_ &&
           a.low.y <= b.high.y + slack_ && b.low.y <= a.high.y + slack_ &&
           a.low.z <= b.high.z + slack_ && b.low.z <= a.high.z + slack_;
  }

  // Pairs with one box in `a` and one in `b`, which comes after it.
  void PairsAcross(const Node& a, const Node& b) {
    if (!Meet(around_[a.index], around_[b.index])) return;
    if (a.IsLeaf() && b.IsLeaf()) {
      visit_(a.begin, b.begin);
    } else if (a.end - a.begin > b.end - b.begin) {
      PairsAcross(a.Child(0), b);
      PairsAcross(a.Child(1), b);
    } else {
      PairsAcross(a, b.Child(0));
      PairsAcross(a, b.Child(1));
    }
  }

  const std::vector<Bounds>& boxes_;
  const double slack_;
  const absl::FunctionRef<void(size_t, size_t)> visit_;
  std::vector<Bounds> around_;  // by index of a node: the children of k are 2 k + 1 and 2 k + 2
};

}  // namespace

void ForEachMeetingPair(const std::vector<Bounds>& boxes, double slack,
                        absl::FunctionRef<void(size_t, size_t)> visit) {
  if (boxes.size() < 2) return;
  PairFinder finder(boxes, slack, visit);
  finder.PairsInside(finder.Root());
}

}  // namespace lambert
