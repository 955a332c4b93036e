#include "radiosity/shoot/emitter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lambert {
namespace {

// Rays start this fraction of a patch inside its edges, where rounding could put an origin beyond
// the neighbouring wall. Moves the mean origin by nothing and its spread by 2e-5 of the patch.
constexpr float kEdgeMargin = 1.0f / 131072;

struct Point8 {
  Float8 b1, b2;  // barycentric weights of corners 1 and 2
};

// Uniform on a triangle: b0 = 1 - sqrt(u), b2 = v sqrt(u).
inline Point8 TrianglePoint(Float8 u, Float8 v) {
  const Float8 root = Root(u);
  const Float8 b1 = root * (1 - v), b2 = root * v;
  const float inner = 1 - 3 * kEdgeMargin;
  return {kEdgeMargin + inner * b1, kEdgeMargin + inner * b2};
}

struct Disk8 {
  Float8 x, y;
};

// Uniform on the unit disk (SC97), sine and cosine of an angle in [-pi/4, pi/4] by their series
// (error under 4e-7).
inline Disk8 ConcentricDisk(Float8 u, Float8 v) {
  const Float8 a = 2 * u - 1, b = 2 * v - 1;
  const auto wide = Magnitude(a) > Magnitude(b);
  const Float8 large = wide ? a : b, small = wide ? b : a;
  const Float8 divisor = large == 0 ? Broadcast8(1) : large;
  const Float8 t = 0.785398163f * (small / divisor), t2 = t * t;
  const Float8 sine = t * (1 + t2 * (-1.0f / 6 + t2 * (1.0f / 120 - t2 * (1.0f / 5040))));
  const Float8 cosine = 1 + t2 * (-0.5f + t2 * (1.0f / 24 + t2 * (-1.0f / 720 + t2 / 40320)));
  const Float8 p = large * cosine, q = large * sine;
  return {wide ? p : q, wide ? q : p};
}

// One frame for all lanes, as it lies.
EmitterFrame8 Spread(const EmitterFrame& frame) {
  EmitterFrame8 f;
  for (int k = 0; k < 3; ++k) {
    f.corner[k] = Broadcast8(frame.corner[k]);
    f.edge1[k] = Broadcast8(frame.edge1[k]);
    f.edge2[k] = Broadcast8(frame.edge2[k]);
    f.x[k] = Broadcast8(frame.x[k]);
    f.y[k] = Broadcast8(frame.y[k]);
    f.z[k] = Broadcast8(frame.z[k]);
  }
  return f;
}

// Each puts eight rays from `slot` on, and may read and write slots after the last ray.
inline void PutOrigins(const EmitterFrame8& f, Point8 point, RayBatch& batch, int slot) {
  float* const out[3] = {batch.origin_x, batch.origin_y, batch.origin_z};
  for (int k = 0; k < 3; ++k) {
    Store(f.corner[k] + point.b1 * f.edge1[k] + point.b2 * f.edge2[k] + kOriginOffset * f.z[k],
          out[k] + slot);
  }
}

inline void PutDirections(const EmitterFrame8& f, Float8 x, Float8 y, Float8 z, RayBatch& batch,
                          int slot) {
  float* const out[3] = {batch.direction_x, batch.direction_y, batch.direction_z};
  for (int k = 0; k < 3; ++k) Store(x * f.x[k] + y * f.y[k] + z * f.z[k], out[k] + slot);
}

// A point of the unit disk lifted to the hemisphere: uniform there, cosine law here.
inline void PutDiskDirections(const EmitterFrame8& f, Disk8 disk, RayBatch& batch, int slot) {
  const Float8 left = 1 - disk.x * disk.x - disk.y * disk.y;
  PutDirections(f, disk.x, disk.y, Root(left > 0 ? left : Float8{}), batch, slot);
}

inline Point8 PatchPoint(const RandomNumbers8& random) {
  return TrianglePoint(LoadFloat8(random.numbers[0]), LoadFloat8(random.numbers[1]));
}

template <typename Real>
struct Vector {
  Real x, y, z;
};
template <typename Real>
Vector<Real> Cross(Vector<Real> a, Vector<Real> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <typename Real>
Vector<Real> Unit(Vector<Real> a) {
  const Real length = Root(a.x * a.x + a.y * a.y + a.z * a.z);
  return {a.x / length, a.y / length, a.z / length};
}

template <typename Real>
struct Axes {
  Vector<Real> x, y, z;
};
// The local frame of a triangle. In double: the cross product of two short edges would underflow in
// float.
template <typename Real>
Axes<Real> AxesOf(Vector<Real> edge1, Vector<Real> edge2) {
  Axes<Real> axes;
  axes.z = Unit(Cross(edge1, edge2));
  axes.x = Unit(edge1);
  axes.y = Cross(axes.z, axes.x);
  return axes;
}

// Fills rays begin .. end in groups of eight: `place(slot, numbers)` for each group, also for the
// slots after the end, which the next group overwrites.
template <typename Place>
inline void ForEachGroup(const RayNumbers& source, uint32_t begin, uint32_t end, RayBatch& batch,
                         Place place) {
  RandomNumbers8 numbers;
  for (uint32_t ray = begin; ray < end; ray += 8) {
    source.Fill(ray, numbers);
    place(batch.size, numbers);
    batch.size += static_cast<int>(std::min<uint32_t>(8, end - ray));
  }
}

// The same for rays through pyramids: `directions(ray, triangles, numbers, out)` makes eight.
template <typename Directions>
inline void ForEachPyramidGroup(const EmitterFrame& frame, PyramidOfRay pyramids,
                                const RayNumbers& source, uint32_t begin, uint32_t end,
                                RayBatch& batch, Directions directions) {
  const EmitterFrame8 f = Spread(frame);
  Directions8 d;
  uint32_t ray = begin;
  ForEachGroup(source, begin, end, batch, [&](int slot, const RandomNumbers8& random) {
    const SphericalTriangle* triangles[8];
    for (uint32_t lane = 0; lane < 8; ++lane) {
      triangles[lane] = pyramids[std::min(ray + lane, end - 1) - begin];
    }
    directions(ray, triangles, random, d);
    const auto in_float = [](const double* from) {
      return ToFloat8(_mm256_load_pd(from), _mm256_load_pd(from + 4));
    };
    PutOrigins(f, PatchPoint(random), batch, slot);
    PutDirections(f, in_float(d.x), in_float(d.y), in_float(d.z), batch, slot);
    ray += 8;
  });
}

}  // namespace

Emitters::Emitters(const PatchSet& patches, const RayScene& scene) {
  triangles_.reserve(patches.size());
  for (const auto& corner : patches.corners) {
    const Vec3 a = scene.ToTrace(corner[0]);
    const Vec3 e1 = (corner[1] - corner[0]) * scene.scale();
    const Vec3 e2 = (corner[2] - corner[0]) * scene.scale();
    std::array<float, 9> triangle;
    const Vec3 columns[3] = {a, e1, e2};
    for (int k = 0; k < 3; ++k) {
      triangle[3 * k] = static_cast<float>(columns[k].x);
      triangle[3 * k + 1] = static_cast<float>(columns[k].y);
      triangle[3 * k + 2] = static_cast<float>(columns[k].z);
    }
    triangles_.push_back(triangle);
  }
  for (const PointLight& light : patches.point_lights) {
    const Vec3 p = scene.ToTrace(light.position);
    point_lights_.push_back(
        {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
  }
}

EmitterFrame Emitters::Frame(PatchIndex emitter) const {
  const std::array<float, 9>& t = triangles_[emitter];
  EmitterFrame f;
  for (int k = 0; k < 3; ++k) {
    f.corner[k] = t[k];
    f.edge1[k] = t[3 + k];
    f.edge2[k] = t[6 + k];
  }
  const Axes<double> axes = AxesOf<double>({t[3], t[4], t[5]}, {t[6], t[7], t[8]});
  const Vector<double> rows[3] = {axes.x, axes.y, axes.z};
  float* out[3] = {f.x, f.y, f.z};
  for (int k = 0; k < 3; ++k) {
    out[k][0] = static_cast<float>(rows[k].x);
    out[k][1] = static_cast<float>(rows[k].y);
    out[k][2] = static_cast<float>(rows[k].z);
  }
  return f;
}

EmitterFrame8 Emitters::Frames(const uint32_t emitters[8]) const {
  Float8 rows[8], last;
  for (int lane = 0; lane < 8; ++lane) {
    const std::array<float, 9>& t = triangles_[emitters[lane]];
    rows[lane] = LoadFloat8(t.data());
    last[lane] = t[8];
  }
  Transpose8(rows);
  EmitterFrame8 f;
  for (int k = 0; k < 3; ++k) {
    f.corner[k] = rows[k];
    f.edge1[k] = rows[3 + k];
  }
  f.edge2[0] = rows[6];
  f.edge2[1] = rows[7];
  f.edge2[2] = last;
  const auto half = [&](auto widen) {
    return AxesOf<Double4>({widen(f.edge1[0]), widen(f.edge1[1]), widen(f.edge1[2])},
                           {widen(f.edge2[0]), widen(f.edge2[1]), widen(f.edge2[2])});
  };
  const Axes<Double4> low = half(LowToDouble), high = half(HighToDouble);
  const auto narrow = [](const Vector<Double4>& a, const Vector<Double4>& b, Float8 out[3]) {
    out[0] = ToFloat8(a.x, b.x);
    out[1] = ToFloat8(a.y, b.y);
    out[2] = ToFloat8(a.z, b.z);
  };
  narrow(low.x, high.x, f.x);
  narrow(low.y, high.y, f.y);
  narrow(low.z, high.z, f.z);
  return f;
}

void AppendCosineRays(const EmitterFrame8& frames, const RandomNumbers8& numbers, int count,
                      RayBatch& batch) {
  PutOrigins(frames, PatchPoint(numbers), batch, batch.size);
  PutDiskDirections(frames,
                    ConcentricDisk(LoadFloat8(numbers.numbers[2]), LoadFloat8(numbers.numbers[3])),
                    batch, batch.size);
  batch.size += count;
}

void AppendCosineRays(const EmitterFrame& frame, const RayNumbers& numbers, uint32_t begin,
                      uint32_t end, RayBatch& batch) {
  const EmitterFrame8 f = Spread(frame);
  ForEachGroup(numbers, begin, end, batch, [&](int slot, const RandomNumbers8& random) {
    PutOrigins(f, PatchPoint(random), batch, slot);
    PutDiskDirections(f,
                      ConcentricDisk(LoadFloat8(random.numbers[2]), LoadFloat8(random.numbers[3])),
                      batch, slot);
  });
}

void AppendGridRays(const EmitterFrame& frame, int side, const int32_t* cells,
                    const RayNumbers& numbers, uint32_t begin, uint32_t end, RayBatch& batch) {
  const EmitterFrame8 f = Spread(frame);
  const int before = batch.size, last = static_cast<int>(end - begin) - 1;
  const float width = 1.0f / static_cast<float>(side);
  ForEachGroup(numbers, begin, end, batch, [&](int slot, const RandomNumbers8& random) {
    Int8 cell;
    for (int lane = 0; lane < 8; ++lane) cell[lane] = cells[std::min(slot - before + lane, last)];
    // Cells are few: half a cell keeps the quotient away from whole numbers.
    const Int8 row =
        __builtin_convertvector((ToFloat8(cell) + 0.5f) / static_cast<float>(side), Int8);
    const Float8 u = (ToFloat8(cell - row * side) + LoadFloat8(random.numbers[2])) * width;
    const Float8 v = (ToFloat8(row) + LoadFloat8(random.numbers[3])) * width;
    PutOrigins(f, PatchPoint(random), batch, slot);
    PutDiskDirections(f, ConcentricDisk(u, v), batch, slot);
  });
}

void AppendSphereRays(const float position[3], const RayNumbers& numbers, uint32_t begin,
                      uint32_t end, RayBatch& batch) {
  ForEachGroup(numbers, begin, end, batch, [&](int first, const RandomNumbers8& random) {
    for (int lane = 0; lane < 8; ++lane) {
      const int slot = first + lane;
      const double z = 1 - 2.0 * random.numbers[2][lane];
      const SineCosine angle = SinCos(std::numbers::pi * (2.0 * random.numbers[3][lane] - 1));
      const double radius = std::sqrt(std::max(0.0, 1 - z * z));
      batch.origin_x[slot] = position[0];
      batch.origin_y[slot] = position[1];
      batch.origin_z[slot] = position[2];
      batch.direction_x[slot] = static_cast<float>(radius * angle.cosine);
      batch.direction_y[slot] = static_cast<float>(radius * angle.sine);
      batch.direction_z[slot] = static_cast<float>(z);
    }
  });
}

void AppendSolidAngleRays(const EmitterFrame& frame, PyramidOfRay pyramids,
                          const RayNumbers& numbers, uint32_t begin, uint32_t end, RayBatch& batch,
                          float* cosine) {
  ForEachPyramidGroup(frame, pyramids, numbers, begin, end, batch,
                      [&](uint32_t, const SphericalTriangle* const triangles[8],
                          const RandomNumbers8& random, Directions8& d) {
                        SampleSolidAngle8(triangles, random.numbers[2], random.numbers[3], d);
                        for (int lane = 0; lane < 8; ++lane) {
                          cosine[batch.size + lane] = static_cast<float>(std::max(0.0, d.z[lane]));
                        }
                      });
}

void AppendProjectedAngleRays(const EmitterFrame& frame, PyramidOfRay pyramids,
                              const RayNumbers& numbers, uint32_t begin, uint32_t end,
                              RayBatch& batch) {
  ForEachPyramidGroup(frame, pyramids, numbers, begin, end, batch,
                      [&](uint32_t ray, const SphericalTriangle* const triangles[8],
                          const RandomNumbers8& random, Directions8& d) {
                        SampleSolidAngle8(triangles, random.numbers[2], random.numbers[3], d);
                        double highest[8];
                        for (int lane = 0; lane < 8; ++lane)
                          highest[lane] = triangles[lane]->max_cosine();
                        // Accepted with probability cos theta / max cos theta; the bound keeps a
                        // broken triangle from looping for ever and is never reached otherwise
                        // (acceptance is over 1/4).
                        uint32_t open = 0xFF;
                        for (uint32_t retry = 0; retry < 1000 && open != 0; ++retry) {
                          RandomNumbers8 again;
                          FillRandomNumbers(numbers.stream(), ray, again, RandomPurpose::kRetry,
                                            retry);
                          Directions8 next;
                          SampleSolidAngle8(triangles, again.numbers[0], again.numbers[1], next);
                          for (int lane = 0; lane < 8; ++lane) {
                            if ((open >> lane & 1) == 0) continue;
                            if (again.numbers[2][lane] * highest[lane] < d.z[lane]) {
                              open &= ~(1u << lane);
                              continue;
                            }
                            d.x[lane] = next.x[lane];
                            d.y[lane] = next.y[lane];
                            d.z[lane] = next.z[lane];
                          }
                        }
                      });
}

}  // namespace lambert
