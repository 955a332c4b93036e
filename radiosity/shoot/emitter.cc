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

// Fills rays begin .. end in groups of eight: `place(slot, numbers, lane)` for each lane, also for
// those after the end, which the next group overwrites: a fixed count lets the compiler vectorise.
template <typename Place>
inline void ForEachRay(const RandomStream& stream, uint32_t begin, uint32_t end, RayBatch& batch,
                       Place place) {
  RandomNumbers8 random;
  for (uint32_t ray = begin; ray < end; ray += 8) {
    FillRandomNumbers(stream, ray, random);
    const int first = batch.size;
    for (int lane = 0; lane < 8; ++lane) place(first + lane, random, lane);
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

void AppendCosineRays(const EmitterFrame& frame, const RandomStream& stream, uint32_t begin,
                      uint32_t end, RayBatch& batch) {
  ForEachRay(stream, begin, end, batch, [&](int slot, const RandomNumbers8& random, int lane) {
    PutOrigin(frame, TrianglePoint(random.numbers[0][lane], random.numbers[1][lane]), batch, slot);
    const Disk disk = ConcentricDisk(random.numbers[2][lane], random.numbers[3][lane]);
    const float z = std::sqrt(std::max(0.0f, 1 - disk.x * disk.x - disk.y * disk.y));
    PutDirection(frame, disk.x, disk.y, z, batch, slot);
  });
}

void AppendSphereRays(const float position[3], const RandomStream& stream, uint32_t begin,
                      uint32_t end, RayBatch& batch) {
  ForEachRay(stream, begin, end, batch, [&](int slot, const RandomNumbers8& random, int lane) {
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

void AppendSolidAngleRays(const EmitterFrame& frame, const SphericalTriangle& pyramid,
                          const RandomStream& stream, uint32_t begin, uint32_t end, RayBatch& batch,
                          float* cosine) {
  ForEachRay(stream, begin, end, batch, [&](int slot, const RandomNumbers8& random, int lane) {
    PutOrigin(frame, TrianglePoint(random.numbers[0][lane], random.numbers[1][lane]), batch, slot);
    const Vec3 d = pyramid.SampleSolidAngle(random.numbers[2][lane], random.numbers[3][lane]);
    PutDirection(frame, static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z),
                 batch, slot);
    cosine[slot] = static_cast<float>(std::max(0.0, d.z));
  });
}

Vec3 SampleProjectedAngle(const SphericalTriangle& pyramid, const RandomStream& stream,
                          uint32_t ray, float xi1, float xi2) {
  Vec3 d = pyramid.SampleSolidAngle(xi1, xi2);
  // Accepted with probability cos theta / max cos theta; the bound keeps a broken triangle from
  // looping for ever and is never reached otherwise (acceptance is over 1/4).
  for (uint32_t retry = 0; retry < 1000; ++retry) {
    const auto numbers = RandomNumbers(stream, ray, RandomPurpose::kRetry, retry);
    if (numbers[2] * pyramid.max_cosine() < d.z) break;
    d = pyramid.SampleSolidAngle(numbers[0], numbers[1]);
  }
  return d;
}

void AppendProjectedAngleRays(const EmitterFrame& frame, const SphericalTriangle& pyramid,
                              const RandomStream& stream, uint32_t begin, uint32_t end,
                              RayBatch& batch) {
  const int first = batch.size;
  ForEachRay(stream, begin, end, batch, [&](int slot, const RandomNumbers8& random, int lane) {
    PutOrigin(frame, TrianglePoint(random.numbers[0][lane], random.numbers[1][lane]), batch, slot);
    const uint32_t ray = begin + static_cast<uint32_t>(slot - first);
    const Vec3 d = SampleProjectedAngle(pyramid, stream, ray, random.numbers[2][lane],
                                        random.numbers[3][lane]);
    PutDirection(frame, static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z),
                 batch, slot);
  });
}

}  // namespace lambert
