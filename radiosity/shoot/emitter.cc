#include "radiosity/shoot/emitter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lambert {
namespace {

// Rays start this fraction of a patch inside its edges, where rounding could put an origin beyond
// the neighbouring wall. Moves the mean origin by nothing and its spread by 2e-5 of the patch.
constexpr float kEdgeMargin = 1.0f / 131072;

struct Point2 {
  float b1, b2;  // barycentric weights of corners 1 and 2
};

// Uniform on a triangle: b0 = 1 - sqrt(u), b2 = v sqrt(u).
inline Point2 TrianglePoint(float u, float v) {
  const float root = std::sqrt(u);
  const float b1 = root * (1 - v), b2 = root * v;
  const float inner = 1 - 3 * kEdgeMargin;
  return {kEdgeMargin + inner * b1, kEdgeMargin + inner * b2};
}

struct Disk {
  float x, y;
};

// Uniform on the unit disk (SC97), sine and cosine of an angle in [-pi/4, pi/4] by their series
// (error under 4e-7).
inline Disk ConcentricDisk(float u, float v) {
  const float a = 2 * u - 1, b = 2 * v - 1;
  const bool wide = std::fabs(a) > std::fabs(b);
  const float large = wide ? a : b, small = wide ? b : a;
  const float divisor = large == 0 ? 1.0f : large;
  const float t = 0.785398163f * (small / divisor), t2 = t * t;
  const float sine = t * (1 + t2 * (-1.0f / 6 + t2 * (1.0f / 120 - t2 * (1.0f / 5040))));
  const float cosine = 1 + t2 * (-0.5f + t2 * (1.0f / 24 + t2 * (-1.0f / 720 + t2 / 40320)));
  const float p = large * cosine, q = large * sine;
  return wide ? Disk{p, q} : Disk{q, p};
}

inline void PutOrigin(const EmitterFrame& f, Point2 point, RayBatch& batch, int slot) {
  batch.origin_x[slot] =
      f.corner[0] + point.b1 * f.edge1[0] + point.b2 * f.edge2[0] + kOriginOffset * f.z[0];
  batch.origin_y[slot] =
      f.corner[1] + point.b1 * f.edge1[1] + point.b2 * f.edge2[1] + kOriginOffset * f.z[1];
  batch.origin_z[slot] =
      f.corner[2] + point.b1 * f.edge1[2] + point.b2 * f.edge2[2] + kOriginOffset * f.z[2];
}

inline void PutDirection(const EmitterFrame& f, float x, float y, float z, RayBatch& batch,
                         int slot) {
  batch.direction_x[slot] = x * f.x[0] + y * f.y[0] + z * f.z[0];
  batch.direction_y[slot] = x * f.x[1] + y * f.y[1] + z * f.z[1];
  batch.direction_z[slot] = x * f.x[2] + y * f.y[2] + z * f.z[2];
}

// A point of the unit disk lifted to the hemisphere: uniform there, cosine law here.
inline void PutDiskDirection(const EmitterFrame& f, Disk disk, RayBatch& batch, int slot) {
  const float z = std::sqrt(std::max(0.0f, 1 - disk.x * disk.x - disk.y * disk.y));
  PutDirection(f, disk.x, disk.y, z, batch, slot);
}

// Fills rays begin .. end in groups of eight: `place(slot, numbers, lane)` for each lane, also for
// those after the end, which the next group overwrites: a fixed count lets the compiler vectorise.
template <typename Place>
inline void ForEachRay(const RayNumbers& source, uint32_t begin, uint32_t end, RayBatch& batch,
                       Place place) {
  RandomNumbers8 numbers;
  for (uint32_t ray = begin; ray < end; ray += 8) {
    source.Fill(ray, numbers);
    const int first = batch.size;
    for (int lane = 0; lane < 8; ++lane) place(first + lane, numbers, lane);
    batch.size += static_cast<int>(std::min<uint32_t>(8, end - ray));
  }
}

// The same for rays through pyramids: `directions(ray, triangles, numbers, out)` makes eight.
template <typename Directions>
inline void ForEachPyramidRay(const EmitterFrame& frame, PyramidOfRay pyramids,
                              const RayNumbers& source, uint32_t begin, uint32_t end,
                              RayBatch& batch, Directions directions) {
  RandomNumbers8 numbers;
  Directions8 d;
  for (uint32_t ray = begin; ray < end; ray += 8) {
    source.Fill(ray, numbers);
    const SphericalTriangle* triangles[8];
    for (uint32_t lane = 0; lane < 8; ++lane) {
      triangles[lane] = pyramids[std::min(ray + lane, end - 1) - begin];
    }
    directions(ray, triangles, numbers, d);
    const int first = batch.size;
    for (int lane = 0; lane < 8; ++lane) {
      const int slot = first + lane;
      PutOrigin(frame, TrianglePoint(numbers.numbers[0][lane], numbers.numbers[1][lane]), batch,
                slot);
      PutDirection(frame, static_cast<float>(d.x[lane]), static_cast<float>(d.y[lane]),
                   static_cast<float>(d.z[lane]), batch, slot);
    }
    batch.size += static_cast<int>(std::min<uint32_t>(8, end - ray));
  }
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
  // In double: the cross product of two short edges would underflow in float.
  const Vec3 e1{t[3], t[4], t[5]}, e2{t[6], t[7], t[8]};
  const Vec3 normal = Cross(e1, e2);
  const Vec3 z = normal / std::sqrt(Dot(normal, normal));
  const Vec3 x = e1 / std::sqrt(Dot(e1, e1));
  const Vec3 y = Cross(z, x);
  const Vec3 axes[3] = {x, y, z};
  float* out[3] = {f.x, f.y, f.z};
  for (int k = 0; k < 3; ++k) {
    out[k][0] = static_cast<float>(axes[k].x);
    out[k][1] = static_cast<float>(axes[k].y);
    out[k][2] = static_cast<float>(axes[k].z);
  }
  return f;
}

void AppendCosineRays(const EmitterFrame& frame, const RayNumbers& numbers, uint32_t begin,
                      uint32_t end, RayBatch& batch) {
  ForEachRay(numbers, begin, end, batch, [&](int slot, const RandomNumbers8& random, int lane) {
    PutOrigin(frame, TrianglePoint(random.numbers[0][lane], random.numbers[1][lane]), batch, slot);
    PutDiskDirection(frame, ConcentricDisk(random.numbers[2][lane], random.numbers[3][lane]), batch,
                     slot);
  });
}

void AppendGridRays(const EmitterFrame& frame, int side, const int32_t* cells,
                    const RayNumbers& numbers, uint32_t begin, uint32_t end, RayBatch& batch) {
  const int before = batch.size, last = static_cast<int>(end - begin) - 1;
  const float width = 1.0f / static_cast<float>(side);
  ForEachRay(numbers, begin, end, batch, [&](int slot, const RandomNumbers8& random, int lane) {
    PutOrigin(frame, TrianglePoint(random.numbers[0][lane], random.numbers[1][lane]), batch, slot);
    const int32_t cell = cells[std::min(slot - before, last)];
    const float u = (static_cast<float>(cell % side) + random.numbers[2][lane]) * width;
    const float v = (static_cast<float>(cell / side) + random.numbers[3][lane]) * width;
    PutDiskDirection(frame, ConcentricDisk(u, v), batch, slot);
  });
}

void AppendSphereRays(const float position[3], const RayNumbers& numbers, uint32_t begin,
                      uint32_t end, RayBatch& batch) {
  ForEachRay(numbers, begin, end, batch, [&](int slot, const RandomNumbers8& random, int lane) {
    const double z = 1 - 2.0 * random.numbers[2][lane];
    const SineCosine angle = SinCos(std::numbers::pi * (2.0 * random.numbers[3][lane] - 1));
    const double radius = std::sqrt(std::max(0.0, 1 - z * z));
    batch.origin_x[slot] = position[0];
    batch.origin_y[slot] = position[1];
    batch.origin_z[slot] = position[2];
    batch.direction_x[slot] = static_cast<float>(radius * angle.cosine);
    batch.direction_y[slot] = static_cast<float>(radius * angle.sine);
    batch.direction_z[slot] = static_cast<float>(z);
  });
}

void AppendSolidAngleRays(const EmitterFrame& frame, PyramidOfRay pyramids,
                          const RayNumbers& numbers, uint32_t begin, uint32_t end, RayBatch& batch,
                          float* cosine) {
  ForEachPyramidRay(frame, pyramids, numbers, begin, end, batch,
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
  ForEachPyramidRay(frame, pyramids, numbers, begin, end, batch,
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
