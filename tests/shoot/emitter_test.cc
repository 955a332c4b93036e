#include "radiosity/shoot/emitter.h"

#include <gtest/gtest.h>

#include <memory>
#include <numbers>
#include <string>

#include "radiosity/pyramid/concentric_grid.h"
#include "radiosity/pyramid/hemisphere.h"
#include "tests/support/scenes.h"
#include "tests/support/sphere_bins.h"
#include "tests/support/statistics.h"

namespace lambert {
namespace {

constexpr double kPi = std::numbers::pi;

// Triangles of all shapes and positions, as emitters.
class EmitterTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    Scene scene = MakeCornell(1);
    Primitive odd;
    odd.positions = {{0.2f, 0.3f, 0.4f}, {0.9f, 0.35f, 0.8f}, {0.5f, 1.2f, 0.1f},
                     {1.0f, 1.0f, 1.0f}, {1.9f, 1.1f, 1.05f}, {1.01f, 1.01f, 1.0f}};
    odd.triangles = {{0, 1, 2}, {3, 4, 5}};
    scene.meshes[0].primitives.push_back(odd);
    scene.lights.push_back({"", {0.5, 0.6, 0.7}, {1, 1, 1}});
    patches_ = new PatchSet(PatchesOf(scene));
    scene_ = RayScene::Create(*patches_)->release();
    emitters_ = new Emitters(*patches_, *scene_);
  }

  static inline PatchSet* patches_ = nullptr;
  static inline RayScene* scene_ = nullptr;
  static inline Emitters* emitters_ = nullptr;
};

Vec3 ToVec(const float v[3]) { return {v[0], v[1], v[2]}; }

Vec3 AxisY(const EmitterFrame& f) { return Cross(ToVec(f.z), ToVec(f.x)); }

// Rays [begin, end) of a patch, eight to a group: `append(frames, names, numbers, count)`.
template <typename Append>
void ForGroups(const Emitters& emitters, const RandomStream& stream, uint32_t begin, uint32_t end,
               Append append) {
  for (uint32_t first = begin; first < end; first += 8) {
    RayNames8 names;
    for (uint32_t lane = 0; lane < 8; ++lane) {
      names.emitter[lane] = stream.emitter;
      names.ray[lane] = first + lane;
    }
    RandomNumbers8 numbers;
    FillRandomNumbers(stream, names, numbers);
    append(emitters.Frames(names.emitter), names, numbers,
           static_cast<int>(std::min<uint32_t>(8, end - first)));
  }
}

// The same rays through one pyramid.
struct Through {
  const SphericalTriangle* lanes[8];
  explicit Through(const SphericalTriangle& pyramid) {
    std::fill(std::begin(lanes), std::end(lanes), &pyramid);
  }
};
void AppendProjected(const Emitters& emitters, const SphericalTriangle& pyramid,
                     const RandomStream& stream, uint32_t begin, uint32_t end, RayBatch& batch) {
  ForGroups(emitters, stream, begin, end,
            [&](const EmitterFrame8& frames, const RayNames8& names, const RandomNumbers8& numbers,
                int count) {
              AppendProjectedAngleRays(frames, Through(pyramid).lanes, numbers, stream, names,
                                       count, batch);
            });
}
void AppendSolid(const Emitters& emitters, const SphericalTriangle& pyramid,
                 const RandomStream& stream, uint32_t begin, uint32_t end, RayBatch& batch,
                 float* cosine) {
  ForGroups(
      emitters, stream, begin, end,
      [&](const EmitterFrame8& frames, const RayNames8&, const RandomNumbers8& numbers, int count) {
        AppendSolidAngleRays(frames, Through(pyramid).lanes, numbers, count, batch, cosine);
      });
}
void AppendGrid(const Emitters& emitters, int side, int32_t cell, const RandomStream& stream,
                uint32_t begin, uint32_t end, RayBatch& batch) {
  int32_t cells[8];
  std::fill(std::begin(cells), std::end(cells), cell);
  ForGroups(emitters, stream, begin, end,
            [&](const EmitterFrame8& frames, const RayNames8&, const RandomNumbers8& numbers,
                int count) { AppendGridRays(frames, side, cells, numbers, count, batch); });
}

// What a ray says in the frame of its emitter.
struct LocalRay {
  double b1, b2;  // barycentric weights of its origin
  double height;  // of its origin over the plane
  Vec3 direction;
};

LocalRay Ray(const EmitterFrame& f, const RayBatch& batch, int slot) {
  const Vec3 origin{batch.origin_x[slot], batch.origin_y[slot], batch.origin_z[slot]};
  const Vec3 d{batch.direction_x[slot], batch.direction_y[slot], batch.direction_z[slot]};
  const Vec3 e1 = ToVec(f.edge1), e2 = ToVec(f.edge2), p = origin - ToVec(f.corner);
  const Vec3 normal = Cross(e1, e2);
  const double area2 = Dot(normal, normal);
  return {Dot(Cross(p, e2), normal) / area2,
          Dot(Cross(e1, p), normal) / area2,
          Dot(p, normal) / std::sqrt(area2),
          {Dot(d, ToVec(f.x)), Dot(d, AxisY(f)), Dot(d, ToVec(f.z))}};
}

// 16 equal pieces of a triangle: strips of equal width, each cut into triangles that point up or
// down.
int PositionBin(const LocalRay& ray) {
  const int i = std::clamp(static_cast<int>(4 * ray.b1), 0, 3);
  const int j = std::clamp(static_cast<int>(4 * ray.b2), 0, 3 - i);
  const bool down = 4 * ray.b1 - i + 4 * ray.b2 - j > 1 && i + j < 3;
  return (i * 4 + j) * 2 + down;  // 32 names of which 16 occur
}

// Renumbers the bins that occur.
std::vector<int> PositionNumbers() {
  std::vector<int> number(32, -1);
  int next = 0;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j + i < 4; ++j) {
      number[(i * 4 + j) * 2] = next++;
      if (i + j < 3) number[(i * 4 + j) * 2 + 1] = next++;
    }
  }
  return number;
}

// 3 rings of equal area by 8 sectors of the projected disk: equal flux by the cosine law.
int DiskBin(Vec3 d) {
  const double r2 = d.x * d.x + d.y * d.y, angle = std::atan2(d.y, d.x) + kPi;
  return std::min(2, static_cast<int>(3 * r2)) * 8 + std::min(7, static_cast<int>(angle * 4 / kPi));
}

// Calls `use(slot)` for `count` rays that `append(begin, end, batch)` makes.
template <typename Append, typename Use>
void ForRays(uint32_t count, Append append, Use use) {
  auto batch = std::make_unique<RayBatch>();
  for (uint32_t ray = 0; ray < count; ray += RayBatch::kCapacity) {
    const uint32_t end = std::min<uint32_t>(count, ray + RayBatch::kCapacity);
    batch->size = 0;
    append(ray, end, *batch);
    ASSERT_EQ(batch->size, static_cast<int>(end - ray));
    for (int slot = 0; slot < batch->size; ++slot) use(*batch, slot);
  }
}

TEST_F(EmitterTest, FramesAreThePatchesInTraceCoordinates) {
  ASSERT_EQ(emitters_->patch_count(), patches_->size());
  ASSERT_EQ(emitters_->size(), patches_->size() + 1);
  EXPECT_FALSE(emitters_->IsLight(patches_->size() - 1));
  EXPECT_TRUE(emitters_->IsLight(patches_->size()));
  for (PatchIndex i = 0; i < patches_->size(); ++i) {
    const EmitterFrame f = emitters_->Frame(i);
    const auto& corners = patches_->corners[i];
    const Vec3 a = ToVec(f.corner);
    EXPECT_NEAR(Length(a - scene_->ToTrace(corners[0])), 0, 1e-7);
    EXPECT_NEAR(Length(a + ToVec(f.edge1) - scene_->ToTrace(corners[1])), 0, 2e-7);
    EXPECT_NEAR(Length(a + ToVec(f.edge2) - scene_->ToTrace(corners[2])), 0, 2e-7);
    EXPECT_NEAR(Dot(ToVec(f.z), PatchNormal(*patches_, i)), 1, 1e-6);
    EXPECT_NEAR(Dot(ToVec(f.x), ToVec(f.z)), 0, 1e-6);
    EXPECT_NEAR(Length(ToVec(f.x)), 1, 1e-6);
  }
}

TEST_F(EmitterTest, CosineRaysAreUniformOnThePatchAndFollowTheCosineLawAtOnce) {
  const std::vector<int> numbers = PositionNumbers();
  for (PatchIndex i = 0; i < patches_->size(); i += 5) {
    const EmitterFrame frame = emitters_->Frame(i);
    const RandomStream stream{11, static_cast<uint32_t>(i), 0, 0};
    std::vector<int64_t> counts(16 * 24);
    ForRays(
        20000,
        [&](uint32_t begin, uint32_t end, RayBatch& batch) {
          AppendCosineRays(frame, stream, begin, end, batch);
        },
        [&](const RayBatch& batch, int slot) {
          const LocalRay ray = Ray(frame, batch, slot);
          ++counts[numbers[PositionBin(ray)] * 24 + DiskBin(ray.direction)];
          ASSERT_NEAR(Length(ray.direction), 1, 1e-6);
        });
    EXPECT_LT(ChiSquared(counts, std::vector<double>(counts.size(), 1.0 / counts.size())),
              ChiSquaredQuantile(counts.size() - 1))
        << "patch " << i;
  }
}

TEST_F(EmitterTest, RaysStartAboveTheirPatchAndInsideIt) {
  for (PatchIndex i = 0; i < patches_->size(); ++i) {
    const EmitterFrame frame = emitters_->Frame(i);
    const auto& corners = patches_->corners[i];
    const Vec3 a = scene_->ToTrace(corners[0]), normal = PatchNormal(*patches_, i);
    ForRays(
        2000,
        [&](uint32_t begin, uint32_t end, RayBatch& batch) {
          AppendCosineRays(frame, RandomStream{3, static_cast<uint32_t>(i), 0, 0}, begin, end,
                           batch);
        },
        [&](const RayBatch& batch, int slot) {
          const Vec3 o{batch.origin_x[slot], batch.origin_y[slot], batch.origin_z[slot]};
          // kOriginOffset, up to the rounding of three float coordinates under 1.
          ASSERT_NEAR(Dot(o - a, normal), kOriginOffset, 3.0e-7) << "patch " << i;
          const LocalRay ray = Ray(frame, batch, slot);
          ASSERT_GT(std::min({ray.b1, ray.b2, 1 - ray.b1 - ray.b2}), -1e-5) << "patch " << i;
          ASSERT_GE(ray.direction.z, -1e-6);
        });
  }
}

TEST_F(EmitterTest, SolidAngleRaysAreUniformInTheirPyramidAndKnowTheirCosine) {
  const Hemisphere hemisphere(4, 4, 1);
  const PatchIndex patch = patches_->size() - 1;
  const EmitterFrame frame = emitters_->Frame(patch);
  alignas(64) float cosine[RayBatch::kSlots];
  for (int p = 0; p < hemisphere.size(); ++p) {
    const SphereBins bins(hemisphere.pyramid(p), 2);
    std::vector<int64_t> counts(bins.size());
    ForRays(
        20000,
        [&](uint32_t begin, uint32_t end, RayBatch& batch) {
          AppendSolid(*emitters_, hemisphere.pyramid(p), {7, static_cast<uint32_t>(patch), 0, 0},
                      begin, end, batch, cosine);
        },
        [&](const RayBatch& batch, int slot) {
          const LocalRay ray = Ray(frame, batch, slot);
          ASSERT_NEAR(ray.direction.z, cosine[slot], 1e-6);
          ++counts[bins.Find(ray.direction)];
        });
    EXPECT_LT(ChiSquared(counts, bins.SolidAngleShares()), ChiSquaredQuantile(bins.size() - 1))
        << "pyramid " << p;
  }
}

TEST_F(EmitterTest, ProjectedAngleRaysFollowTheCosineLawInTheirPyramid) {
  for (const Hemisphere& hemisphere :
       {Hemisphere(4, 4, 1), Hemisphere(3, 3, 1), Hemisphere(4, 3, 2), Hemisphere(4, 4, 2)}) {
    const EmitterFrame frame = emitters_->Frame(0);
    for (int p = 0; p < hemisphere.size(); ++p) {
      const SphericalTriangle& pyramid = hemisphere.pyramid(p);
      const SphereBins bins(pyramid, 2);
      std::vector<int64_t> counts(bins.size());
      ForRays(
          20000,
          [&](uint32_t begin, uint32_t end, RayBatch& batch) {
            AppendProjected(*emitters_, pyramid, {8, 0, 0, 0}, begin, end, batch);
          },
          [&](const RayBatch& batch, int slot) {
            const LocalRay ray = Ray(frame, batch, slot);
            ASSERT_GT(SphereBin(pyramid).Inside(ray.direction), -1e-6);
            ++counts[bins.Find(ray.direction)];
          });
      EXPECT_LT(ChiSquared(counts, bins.FluxShares()), ChiSquaredQuantile(bins.size() - 1))
          << "pyramid " << p << " of " << hemisphere.size();
    }
  }
}

TEST_F(EmitterTest, GridRaysFollowTheCosineLawInTheirSquare) {
  const EmitterFrame frame = emitters_->Frame(1);
  constexpr int kSide = 5;
  const ConcentricGrid grid(kSide), finer(2 * kSide);
  for (int32_t cell = 0; cell < grid.size(); ++cell) {
    std::vector<int64_t> counts(4);
    ForRays(
        20000,
        [&](uint32_t begin, uint32_t end, RayBatch& batch) {
          AppendGrid(*emitters_, kSide, cell, {9, 1, 0, 0}, begin, end, batch);
        },
        [&](const RayBatch& batch, int slot) {
          const int at = finer.Locate(Ray(frame, batch, slot).direction);
          // Rounding may put a ray at a border into the next square.
          const int x = std::clamp(at % finer.side() - 2 * (cell % kSide), 0, 1);
          const int y = std::clamp(at / finer.side() - 2 * (cell / kSide), 0, 1);
          ++counts[y * 2 + x];
        });
    EXPECT_LT(ChiSquared(counts, std::vector<double>(4, 0.25)), ChiSquaredQuantile(3)) << cell;
  }
}

TEST_F(EmitterTest, RaysDoNotDependOnHowTheirRangeIsCut) {
  const EmitterFrame frame = emitters_->Frame(2);
  const SphericalTriangle pyramid = Hemisphere(4, 4, 1).pyramid(5);
  const RandomStream stream{1, 2, 3, 4};
  alignas(64) float cosine[RayBatch::kSlots];
  const auto weight = std::make_unique<Rgb[]>(RayBatch::kSlots);
  const auto append = [&](int kind, uint32_t begin, uint32_t end, RayBatch& batch) {
    if (kind == 0) AppendCosineRays(frame, stream, begin, end, batch);
    if (kind == 1)
      emitters_->LightOf(patches_->size()).Append(stream, begin, end, batch, weight.get());
    if (kind == 2) AppendSolid(*emitters_, pyramid, stream, begin, end, batch, cosine);
    if (kind == 3) AppendProjected(*emitters_, pyramid, stream, begin, end, batch);
    if (kind == 4) AppendGrid(*emitters_, 8, 5, stream, begin, end, batch);
    const RayNumbers sobol(stream, Sequence::kSobol);
    if (kind == 5) AppendCosineRays(frame, sobol, begin, end, batch);
  };
  TestRandom random(6);
  auto whole = std::make_unique<RayBatch>(), parts = std::make_unique<RayBatch>();
  for (int kind = 0; kind < 6; ++kind) {
    whole->size = parts->size = 0;
    append(kind, 0, 1000, *whole);
    for (uint32_t begin = 0; begin < 1000;) {
      const uint32_t end = std::min<uint32_t>(1000, begin + 1 + random.Below(40));
      append(kind, begin, end, *parts);
      begin = end;
    }
    ASSERT_EQ(parts->size, 1000);
    for (int k = 0; k < 1000; ++k) {
      ASSERT_EQ(parts->origin_x[k], whole->origin_x[k]) << kind << " " << k;
      ASSERT_EQ(parts->origin_y[k], whole->origin_y[k]) << kind << " " << k;
      ASSERT_EQ(parts->origin_z[k], whole->origin_z[k]) << kind << " " << k;
      ASSERT_EQ(parts->direction_x[k], whole->direction_x[k]) << kind << " " << k;
      ASSERT_EQ(parts->direction_y[k], whole->direction_y[k]) << kind << " " << k;
      ASSERT_EQ(parts->direction_z[k], whole->direction_z[k]) << kind << " " << k;
    }
  }
}

}  // namespace
}  // namespace lambert
