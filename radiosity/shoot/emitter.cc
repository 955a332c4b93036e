#include "radiosity/shoot/emitter.h"

#include <algorithm>
#include <cmath>

#include "radiosity/pyramid/local_frame.h"

namespace lambert {
namespace {

// Rays start this fraction of a patch inside its edges, where rounding could put an origin beyond
// the neighbouring wall. Moves the mean origin by nothing and its spread by 2e-5 of the patch.
constexpr float kEdgeMargin = 1.0f / 131072;

struct Point8 {
  Float8 b1, b2;  // barycentric weights of corners 1 and 2
};

// Away from the edges.
inline Point8 Inside(Point8 at) {
  const float inner = 1 - 3 * kEdgeMargin;
  return {kEdgeMargin + inner * at.b1, kEdgeMargin + inner * at.b2};
}

// Uniform on a triangle: b0 = 1 - sqrt(u), b2 = v sqrt(u).
inline Point8 TrianglePoint(Float8 u, Float8 v) {
  const Float8 root = Root(u);
  return Inside({root * (1 - v), root * v});
}

// The point of a triangle with these weights, where rounding has put it outside.
inline Point8 Clamped(Point8 at) {
  const Float8 b1 = at.b1 > 0 ? at.b1 : Float8{}, b2 = at.b2 > 0 ? at.b2 : Float8{};
  const Float8 sum = b1 + b2, scale = sum > 1 ? 1 / sum : Broadcast8(1);
  return {b1 * scale, b2 * scale};
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

// Frames lane by lane.
EmitterFrame8 Gather(const EmitterFrame* const frames[8]) {
  const float* rows[8];
  for (int lane = 0; lane < 8; ++lane) rows[lane] = reinterpret_cast<const float*>(frames[lane]);
  Float8 columns[16];
  LoadColumns16(rows, columns);
  const auto vector = [&](int k) {
    return Vector<Float8>{columns[k], columns[k + 1], columns[k + 2]};
  };
  const Vector<Float8> x = vector(9), z = vector(12);
  return {vector(0), vector(3), vector(6), x, Cross(z, x), z};
}

// Each puts eight rays from `slot` on, and may write slots after the last ray.
inline void PutOrigins(const EmitterFrame8& f, Point8 at, RayBatch& batch, int slot) {
  const Vector<Float8> origin =
      f.corner + at.b1 * f.edge1 + at.b2 * f.edge2 + Broadcast8(kOriginOffset) * f.z;
  Store(origin.x, batch.origin_x + slot);
  Store(origin.y, batch.origin_y + slot);
  Store(origin.z, batch.origin_z + slot);
}

inline void PutOrigins(const EmitterFrame8& f, const RandomNumbers8& numbers, RayBatch& batch,
                       int slot) {
  const Float8 u = LoadFloat8(numbers.numbers[0]), v = LoadFloat8(numbers.numbers[1]);
  PutOrigins(f, TrianglePoint(u, v), batch, slot);
}

inline void PutDirections(const EmitterFrame8& f, Vector<Float8> local, RayBatch& batch, int slot) {
  const Vector<Float8> direction = local.x * f.x + local.y * f.y + local.z * f.z;
  Store(direction.x, batch.direction_x + slot);
  Store(direction.y, batch.direction_y + slot);
  Store(direction.z, batch.direction_z + slot);
}

// A point of the unit disk lifted to the hemisphere: uniform there, cosine law here.
inline Vector<Float8> Lifted(Disk8 disk) {
  const Float8 left = 1 - disk.x * disk.x - disk.y * disk.y;
  return {disk.x, disk.y, Root(left > 0 ? left : Float8{})};
}

inline void PutCosineDirections(const EmitterFrame8& f, const float numbers[2][8], RayBatch& batch,
                                int slot) {
  const Float8 u = LoadFloat8(numbers[0]), v = LoadFloat8(numbers[1]);
  PutDirections(f, Lifted(ConcentricDisk(u, v)), batch, slot);
}

inline void PutCosineRays(const EmitterFrame8& f, const RandomNumbers8& numbers, RayBatch& batch,
                          int slot) {
  PutOrigins(f, numbers, batch, slot);
  PutCosineDirections(f, numbers.numbers + 2, batch, slot);
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

}  // namespace

Emitters::Emitters(const PatchSet& patches, const RayScene& scene, const SurfaceTree* tree) {
  frames_.reserve(patches.size());
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const auto& corner = patches.corners[i];
    EmitterFrame& frame = frames_.emplace_back();
    ToFloats(scene.ToTrace(corner[0]), frame.corner);
    ToFloats((corner[1] - corner[0]) * scene.scale(), frame.edge1);
    ToFloats((corner[2] - corner[0]) * scene.scale(), frame.edge2);
    const LocalFrame local =
        tree != nullptr ? PlaceFrame(patches, *tree, i) : PatchFrame(patches, i);
    ToFloats(local.x, frame.x);
    ToFloats(local.z, frame.z);
  }
  if (patches.lights.empty()) return;
  const Bounds box = BoundsOf(patches);
  for (const Light& light : patches.lights) lights_.emplace_back(light, box, scene);
}

EmitterFrame8 Emitters::Frames(const uint32_t emitters[8]) const {
  const EmitterFrame* frames[8];
  for (int lane = 0; lane < 8; ++lane) frames[lane] = &frames_[emitters[lane]];
  return Gather(frames);
}

void AppendCosineRays(const EmitterFrame8& frames, const RandomNumbers8& numbers, int count,
                      RayBatch& batch) {
  PutCosineRays(frames, numbers, batch, batch.size);
  batch.size += count;
}

void AppendCosineRays(const EmitterFrame8& frames, const float u[8], const float v[8],
                      const float direction[2][8], int count, RayBatch& batch) {
  const Point8 at = Inside(Clamped({LoadFloat8(u), LoadFloat8(v)}));
  PutOrigins(frames, at, batch, batch.size);
  PutCosineDirections(frames, direction, batch, batch.size);
  batch.size += count;
}

void AppendCosineRays(const EmitterFrame& frame, const RayNumbers& numbers, uint32_t begin,
                      uint32_t end, RayBatch& batch) {
  const EmitterFrame* one[8];
  std::fill(std::begin(one), std::end(one), &frame);
  const EmitterFrame8 f = Gather(one);
  ForEachGroup(numbers, begin, end, batch, [&](int slot, const RandomNumbers8& random) {
    PutCosineRays(f, random, batch, slot);
  });
}

void AppendSolidAngleRays(const EmitterFrame8& frames, const SphericalTriangle* const pyramids[8],
                          const RandomNumbers8& numbers, int count, RayBatch& batch,
                          float* cosine) {
  Directions8 d;
  SampleSolidAngle8(pyramids, numbers.numbers[2], numbers.numbers[3], d);
  const auto in_float = [](const double* from) {
    return ToFloat8(_mm256_load_pd(from), _mm256_load_pd(from + 4));
  };
  const Vector<Float8> local{in_float(d.x), in_float(d.y), in_float(d.z)};
  PutOrigins(frames, numbers, batch, batch.size);
  PutDirections(frames, local, batch, batch.size);
  Store(local.z > 0 ? local.z : Float8{}, cosine + batch.size);
  batch.size += count;
}

void AppendProjectedAngleRays(const EmitterFrame8& frames,
                              const SphericalTriangle* const pyramids[8],
                              const RandomNumbers8& numbers, const RandomStream& stream,
                              const RayNames8& names, int count, RayBatch& batch) {
  alignas(32) float first[8];
  const DiskPiece* of_lane[8];
  for (int lane = 0; lane < 8; ++lane) {
    first[lane] = numbers.numbers[2][lane];
    of_lane[lane] = &pyramids[lane]->PickPiece(first[lane]);
  }
  const DiskPiece8 pieces(of_lane);
  DiskTrial trial = pieces.Try(LoadFloat8(first), LoadFloat8(numbers.numbers[3]));
  // Most pieces take over 2/5 of all trials; the bound keeps a broken one from looping for ever.
  // Each four numbers are two trials.
  RandomNumbers8 more;
  for (uint32_t retry = 0; retry < 100000 && AnyLane(~trial.inside); ++retry) {
    const uint32_t pair = 2 * (retry % 2);
    if (pair == 0) FillRandomNumbers(stream, names, more, RandomPurpose::kRetry, retry / 2);
    const DiskTrial next =
        pieces.Try(LoadFloat8(more.numbers[pair]), LoadFloat8(more.numbers[pair + 1]));
    trial.direction.x = trial.inside ? trial.direction.x : next.direction.x;
    trial.direction.y = trial.inside ? trial.direction.y : next.direction.y;
    trial.direction.z = trial.inside ? trial.direction.z : next.direction.z;
    trial.inside |= next.inside;
  }
  PutOrigins(frames, numbers, batch, batch.size);
  PutDirections(frames, trial.direction, batch, batch.size);
  batch.size += count;
}

void AppendGridRays(const EmitterFrame8& frames, int side, const int32_t cells[8],
                    const RandomNumbers8& numbers, int count, RayBatch& batch) {
  const float width = 1.0f / static_cast<float>(side);
  const Int8 cell = LoadInt8(cells);
  // Cells are few: half a cell keeps the product away from whole numbers.
  const Int8 row = __builtin_convertvector((ToFloat8(cell) + 0.5f) * width, Int8);
  const Float8 u = (ToFloat8(cell - row * side) + LoadFloat8(numbers.numbers[2])) * width;
  const Float8 v = (ToFloat8(row) + LoadFloat8(numbers.numbers[3])) * width;
  PutOrigins(frames, numbers, batch, batch.size);
  PutDirections(frames, Lifted(ConcentricDisk(u, v)), batch, batch.size);
  batch.size += count;
}

}  // namespace lambert
