#include "examples/box_model.h"

#include <algorithm>
#include <cmath>

namespace lambert::examples {
namespace {

constexpr double kTouch_m = 1e-9;  // coordinates that are nearer than this are the same
constexpr double kGrading = 4;     // widest ratio of neighbouring gaps of a grid
constexpr int kAir = -1;

using Lines = std::array<std::vector<double>, 3>;  // the planes of a grid, along each axis

// Sorts the cuts, drops repeated ones and divides every gap into equal parts of at most max_gap_m.
std::vector<double> Divide(std::vector<double> cuts, double max_gap_m) {
  std::sort(cuts.begin(), cuts.end());
  std::vector<double> lines{cuts.front()};
  for (double cut : cuts) {
    const double begin = lines.back(), gap_m = cut - begin;
    if (gap_m < kTouch_m) continue;
    const int parts = static_cast<int>(std::ceil(gap_m / max_gap_m - kTouch_m));
    for (int i = 1; i < parts; ++i) lines.push_back(begin + gap_m * i / parts);
    lines.push_back(cut);
  }
  return lines;
}

// Halves gaps that are more than kGrading times as wide as one beside them, until none is.
void Grade(std::vector<double>& lines) {
  for (size_t i = 0; i + 1 < lines.size();) {
    const double gap_m = lines[i + 1] - lines[i];
    const double before_m = i > 0 ? lines[i] - lines[i - 1] : gap_m;
    const double after_m = i + 2 < lines.size() ? lines[i + 2] - lines[i + 1] : gap_m;
    if (gap_m <= kGrading * std::min(before_m, after_m)) {
      ++i;
      continue;
    }
    lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(i) + 1, lines[i] + gap_m / 2);
    i -= i > 0 ? 1 : 0;  // the half may be too narrow for the gap before it
  }
}

bool Contains(const Box& box, const std::array<double, 3>& point) {
  for (int axis = 0; axis < 3; ++axis) {
    if (point[axis] < box.lo[axis] - kTouch_m || point[axis] > box.hi[axis] + kTouch_m)
      return false;
  }
  return true;
}

int ObjectAt(const std::vector<Box>& boxes, const std::array<double, 3>& point, int otherwise) {
  for (const Box& box : boxes) {
    if (Contains(box, point)) return box.object;
  }
  return otherwise;
}

Vec3 ToVec3(const std::array<double, 3>& p) { return {p[0], p[1], p[2]}; }

// The quad over [u0, u1] x [v0, v1] of the plane `axis` = at; u and v are the next axes in turn.
Quad MakeQuad(int axis, double at, std::array<double, 2> u, std::array<double, 2> v,
              bool faces_up_the_axis, int object) {
  const int u_axis = (axis + 1) % 3, v_axis = (axis + 2) % 3;
  Quad quad;
  quad.object = object;
  for (int corner = 0; corner < 4; ++corner) {
    std::array<double, 3> p;
    p[axis] = at;
    p[u_axis] = u[corner == 1 || corner == 2];
    p[v_axis] = v[corner >= 2];
    quad.corners[faces_up_the_axis ? corner : 3 - corner] = ToVec3(p);
  }
  return quad;
}

// Which box fills each cell of a grid, in the order x, y, z (z fastest); kAir for none.
class Cells {
 public:
  Cells(const std::vector<Box>& boxes, const Lines& lines) : lines_(lines) {
    for (int axis = 0; axis < 3; ++axis) size_[axis] = static_cast<int>(lines[axis].size()) - 1;
    objects_.reserve(static_cast<size_t>(size_[0]) * size_[1] * size_[2]);
    std::array<int, 3> i;
    for (i[0] = 0; i[0] < size_[0]; ++i[0]) {
      for (i[1] = 0; i[1] < size_[1]; ++i[1]) {
        for (i[2] = 0; i[2] < size_[2]; ++i[2])
          objects_.push_back(ObjectAt(boxes, Centre(i), kAir));
      }
    }
  }

  int size(int axis) const { return size_[axis]; }

  // kAir outside of the grid.
  int At(const std::array<int, 3>& i) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (i[axis] < 0 || i[axis] >= size_[axis]) return kAir;
    }
    return objects_[(static_cast<size_t>(i[0]) * size_[1] + i[1]) * size_[2] + i[2]];
  }

 private:
  std::array<double, 3> Centre(const std::array<int, 3>& i) const {
    std::array<double, 3> p;
    for (int a = 0; a < 3; ++a) p[a] = (lines_[a][i[a]] + lines_[a][i[a] + 1]) / 2;
    return p;
  }

  const Lines& lines_;
  std::array<int, 3> size_;
  std::vector<int> objects_;
};

// Faces of the filled cells across the planes of one axis, on one side.
void AppendFaces(const Cells& cells, const Lines& lines, const Room& room, int axis, bool up,
                 std::vector<Quad>& quads) {
  const int u_axis = (axis + 1) % 3, v_axis = (axis + 2) % 3;
  std::array<int, 3> i;
  for (i[axis] = 0; i[axis] < cells.size(axis); ++i[axis]) {
    const double at = lines[axis][i[axis] + (up ? 1 : 0)];
    const double wall = up ? room.hi[axis] : room.lo[axis];
    if (std::abs(at - wall) < kTouch_m) continue;
    for (i[u_axis] = 0; i[u_axis] < cells.size(u_axis); ++i[u_axis]) {
      for (i[v_axis] = 0; i[v_axis] < cells.size(v_axis); ++i[v_axis]) {
        std::array<int, 3> neighbour = i;
        neighbour[axis] += up ? 1 : -1;
        if (cells.At(i) == kAir || cells.At(neighbour) != kAir) continue;
        const auto& u = lines[u_axis];
        const auto& v = lines[v_axis];
        quads.push_back(MakeQuad(axis, at, {u[i[u_axis]], u[i[u_axis] + 1]},
                                 {v[i[v_axis]], v[i[v_axis] + 1]}, up, cells.At(i)));
      }
    }
  }
}

// The grid of one wall: cut along every box and region that touches its plane.
Lines WallLines(const Room& room, int axis, double at, const std::vector<Box>& boxes,
                const std::vector<Box>& paint, double max_edge_m) {
  Lines lines;
  for (int along : {(axis + 1) % 3, (axis + 2) % 3}) {
    std::vector<double> cuts{room.lo[along], room.hi[along]};
    for (const std::vector<Box>* list : {&boxes, &paint}) {
      for (const Box& box : *list) {
        if (box.lo[axis] > at + kTouch_m || box.hi[axis] < at - kTouch_m) continue;
        cuts.insert(cuts.end(), {box.lo[along], box.hi[along]});
      }
    }
    lines[along] = Divide(std::move(cuts), max_edge_m);
    Grade(lines[along]);
  }
  return lines;
}

// One wall of the room as a grid of quads, without those that a box covers.
void AppendWall(const Room& room, int axis, bool high, const std::vector<Box>& boxes,
                const std::vector<Box>& paint, double max_edge_m, std::vector<Quad>& quads) {
  const double at = high ? room.hi[axis] : room.lo[axis];
  const Lines lines = WallLines(room, axis, at, boxes, paint, max_edge_m);
  const auto& u = lines[(axis + 1) % 3];
  const auto& v = lines[(axis + 2) % 3];
  for (size_t i = 0; i + 1 < u.size(); ++i) {
    for (size_t j = 0; j + 1 < v.size(); ++j) {
      std::array<double, 3> centre;
      centre[axis] = at;
      centre[(axis + 1) % 3] = (u[i] + u[i + 1]) / 2;
      centre[(axis + 2) % 3] = (v[j] + v[j + 1]) / 2;
      if (ObjectAt(boxes, centre, kAir) != kAir) continue;
      const int object = ObjectAt(paint, centre, room.objects[axis * 2 + (high ? 1 : 0)]);
      quads.push_back(MakeQuad(axis, at, {u[i], u[i + 1]}, {v[j], v[j + 1]}, !high, object));
    }
  }
}

}  // namespace

std::vector<Quad> BoxFaces(const std::vector<Box>& boxes, const Room& room, double max_edge_m) {
  Lines lines;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> cuts;
    for (const Box& box : boxes) cuts.insert(cuts.end(), {box.lo[axis], box.hi[axis]});
    lines[axis] = Divide(std::move(cuts), max_edge_m);
  }
  const Cells cells(boxes, lines);
  std::vector<Quad> quads;
  for (int axis = 0; axis < 3; ++axis) {
    for (bool up : {false, true}) AppendFaces(cells, lines, room, axis, up, quads);
  }
  return quads;
}

std::vector<Quad> RoomFaces(const Room& room, const std::vector<Box>& boxes,
                            const std::vector<Box>& paint, double max_edge_m) {
  std::vector<Quad> quads;
  for (int axis = 0; axis < 3; ++axis) {
    for (bool high : {false, true}) AppendWall(room, axis, high, boxes, paint, max_edge_m, quads);
  }
  return quads;
}

}  // namespace lambert::examples
