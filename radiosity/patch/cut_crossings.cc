#include "radiosity/patch/cut_crossings.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "radiosity/core/bounds.h"
#include "radiosity/patch/box_pairs.h"
#include "radiosity/patch/crossing.h"
#include "radiosity/patch/morton.h"
#include "radiosity/patch/shape.h"

namespace lambert {
namespace {

using Corners = std::array<Vec3, 3>;

constexpr double kSlack = 1e-6;      // diagonals of the scene
constexpr double kLeastSine = 1e-3;  // between planes that cut each other
constexpr size_t kMostCuts = 1000;

struct Less {
  bool operator()(const Vec3& a, const Vec3& b) const {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  }
};
using Edge = std::pair<Vec3, Vec3>;
struct LessEdge {
  bool operator()(const Edge& a, const Edge& b) const {
    if (Less()(a.first, b.first) || Less()(b.first, a.first)) return Less()(a.first, b.first);
    return Less()(a.second, b.second);
  }
};
using Points = std::set<Vec3, Less>;

Edge EdgeOf(const Corners& corners, int k) {
  const Vec3 a = corners[k], b = corners[(k + 1) % 3];
  return Less()(a, b) ? Edge(a, b) : Edge(b, a);
}

class Cutter {
 public:
  explicit Cutter(const std::vector<Corners>& triangles) : triangles_(triangles) {}

  std::map<int64_t, std::vector<SplitPiece>> Run(int64_t most_pieces) {
    Prepare();
    ForEachMeetingPair(boxes_, slack_m_, [this](size_t i, size_t j) {
      const int64_t a = std::min(order_[i], order_[j]), b = std::max(order_[i], order_[j]);
      Meet(a, b);
      Meet(b, a);
    });
    CutTheLargest(most_pieces);
    CloseEdges();
    for (auto& [number, pieces] : pieces_) CloseInside(pieces);
    return std::move(pieces_);
  }

 private:
  void Prepare() {
    std::vector<Vec3> centers;
    std::vector<int64_t> numbers;
    for (size_t i = 0; i < triangles_.size(); ++i) {
      planes_.push_back({});
      if (IsDegenerate(triangles_[i], Measure(triangles_[i]))) continue;
      planes_.back() = PlaneThrough(triangles_[i]);
      const auto& [a, b, c] = triangles_[i];
      centers.push_back((a + b + c) / 3);
      numbers.push_back(static_cast<int64_t>(i));
    }
    const std::vector<uint64_t> codes = MortonCodes(centers);
    std::vector<size_t> order(numbers.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return codes[a] < codes[b]; });
    Bounds all;
    for (size_t k : order) {
      order_.push_back(numbers[k]);
      const Corners& corners = triangles_[numbers[k]];
      Bounds box{corners[0], corners[0]};
      for (const Vec3& p : corners) box.Add(p);
      all = boxes_.empty() ? box : all;
      all.Add(box);
      boxes_.push_back(box);
    }
    slack_m_ = kSlack * all.Diagonal();
  }

  // Notes where triangle `other` cuts triangle `number`.
  void Meet(int64_t number, int64_t other) {
    const Corners &whole = triangles_[number], &cutter = triangles_[other];
    const TrianglePlane& plane = planes_[number];
    double height[3];
    for (int k = 0; k < 3; ++k) height[k] = plane.Height(cutter[k]);
    const auto [low, high] = std::minmax({height[0], height[1], height[2]});
    if (low > slack_m_ || high < -slack_m_) return;
    if (Length(Cross(plane.normal, planes_[other].normal)) < kLeastSine) return;
    const std::optional<Segment3> segment = MeetPlane(cutter, plane, slack_m_);
    if (!segment || !InsidePart(*segment, whole, plane.normal, slack_m_)) return;
    cutters_[number].push_back(other);
  }

  void NoteOnEdge(const Corners& whole, Vec3 point) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = whole[k], way = whole[(k + 1) % 3] - a;
      const double length = Length(way), along = Dot(point - a, way) / length;
      if (along <= slack_m_ || along >= length - slack_m_) continue;
      if (Length(a + way * (along / length) - point) > slack_m_) continue;
      on_edges_[EdgeOf(whole, k)].insert(point);
    }
  }

  // Large triangles lose most where others cover parts of them.
  void CutTheLargest(int64_t most_pieces) {
    std::vector<std::pair<double, int64_t>> order;
    for (const auto& [number, cutters] : cutters_) {
      order.push_back({-Measure(triangles_[number]).area_m2, number});
    }
    std::sort(order.begin(), order.end());
    int64_t pieces = 0;
    for (const auto& [area, number] : order) {
      if (pieces >= most_pieces) return;
      Cut(number, cutters_[number]);
      pieces += static_cast<int64_t>(pieces_[number].size());
    }
  }

  void Cut(int64_t number, std::vector<int64_t>& cutters) {
    std::sort(cutters.begin(), cutters.end());
    if (cutters.size() > kMostCuts) cutters.resize(kMostCuts);
    const Corners& whole = triangles_[number];
    const Vec3 normal = planes_[number].normal;
    std::vector<SplitPiece>& pieces = pieces_[number];
    pieces = {WholePiece(whole)};
    for (int64_t other : cutters) {
      const std::optional<Segment3> segment =
          MeetPlane(triangles_[other], planes_[number], slack_m_);
      CutAlong(*segment, planes_[other], normal, slack_m_, &pieces);
    }
    for (const SplitPiece& piece : pieces) {
      for (const SplitCorner& corner : piece) NoteOnEdge(whole, corner.position);
    }
  }

  // Points that one of the triangles at an edge has on it, the others get too.
  void CloseEdges() {
    if (on_edges_.empty()) return;
    for (int64_t number : order_) {
      for (int k = 0; k < 3; ++k) {
        const auto points = on_edges_.find(EdgeOf(triangles_[number], k));
        if (points == on_edges_.end()) continue;
        std::vector<SplitPiece>& pieces = pieces_[number];
        if (pieces.empty()) pieces = {WholePiece(triangles_[number])};
        for (const Vec3& point : points->second) InsertCorner(point, slack_m_, &pieces);
      }
    }
  }

  // The same between the pieces of one triangle.
  void CloseInside(std::vector<SplitPiece>& pieces) {
    Points corners;
    for (const SplitPiece& piece : pieces) {
      for (const SplitCorner& corner : piece) corners.insert(corner.position);
    }
    for (const Vec3& point : corners) InsertCorner(point, slack_m_, &pieces);
  }

  const std::vector<Corners>& triangles_;
  std::vector<TrianglePlane> planes_;  // by number
  std::vector<int64_t> order_;         // numbers of those with area, in Morton order
  std::vector<Bounds> boxes_;          // in that order
  double slack_m_ = 0;
  std::map<int64_t, std::vector<int64_t>> cutters_;
  std::map<Edge, Points, LessEdge> on_edges_;  // cuts on whole edges, beside their ends
  std::map<int64_t, std::vector<SplitPiece>> pieces_;
};

}  // namespace

std::map<int64_t, std::vector<SplitPiece>> CutCrossings(
    const std::vector<std::array<Vec3, 3>>& triangles, int64_t most_pieces) {
  return Cutter(triangles).Run(most_pieces);
}

}  // namespace lambert
