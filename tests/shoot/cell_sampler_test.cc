#include "radiosity/shoot/cell_sampler.h"

#include <gtest/gtest.h>

#include <memory>

#include "radiosity/trace/ray_scene.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

TEST(CellSampler, SendsEveryRayThroughItsCellAndWeighsItsFlux) {
  const PatchSet patches = PatchesOf(MakeCornell(1));
  const auto scene = *RayScene::Create(patches);
  const EmitterFrame frame = Emitters(patches, *scene).Frame(0);
  for (int kind = 0; kind < 3; ++kind) {
    PyramidOptions options;
    options.depth = 1;
    options.grid = 4;
    if (kind == 1) options.sampling = PyramidSampling::kSolidAngle;
    if (kind == 2) options.cells = CellShape::kSquare;
    const CellSampler sampler(options);
    EXPECT_EQ(sampler.weighted(), kind == 1);
    EXPECT_EQ(sampler.cells().size(), 16);
    if (kind < 2) {
      EXPECT_EQ(sampler.hemisphere().size(), 16);
    }
    auto batch = std::make_unique<RayBatch>();
    float weight[RayBatch::kSlots];
    for (int p = 0; p < 16; ++p) {
      batch->size = 0;
      const std::vector<int32_t> cells(1000, p);
      sampler.Append(frame, {}, cells.data(), RandomStream{3, 0, 0, 0}, 0, 1000, *batch, weight);
      ASSERT_EQ(batch->size, 1000);
      double mean = 0;
      int outside = 0;
      for (int k = 0; k < 1000; ++k) {
        const Vec3 d{batch->direction_x[k], batch->direction_y[k], batch->direction_z[k]};
        const auto along = [&](const float axis[3]) {
          return d.x * axis[0] + d.y * axis[1] + d.z * axis[2];
        };
        outside += sampler.cells().Locate({along(frame.x), along(frame.y), along(frame.z)}) != p;
        mean += sampler.weighted() ? weight[k] / 1000.0 : 1e-3;
      }
      EXPECT_LE(outside, 1) << kind << " " << p;  // float32 at a border
      EXPECT_NEAR(mean, 1, 5 * 0.6 / std::sqrt(1000)) << kind << " " << p;
    }
  }
}

}  // namespace
}  // namespace lambert
