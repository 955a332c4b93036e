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
  const Emitters emitters(patches, *scene);
  const EmitterFrame& frame = emitters.Frame(0);
  const RandomStream stream{3, 0, 0, 0};
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
      for (uint32_t ray = 0; ray < 1000; ray += 8) {
        CellRays8 rays;
        for (uint32_t lane = 0; lane < 8; ++lane) {
          rays.names.emitter[lane] = 0;
          rays.names.ray[lane] = ray + lane;
          rays.cells[lane] = p;
          rays.pyramids[lane] = sampler.Pyramid({}, p);
        }
        EXPECT_EQ(rays.pyramids[0] == nullptr, kind == 2);
        RandomNumbers8 numbers;
        FillRandomNumbers(stream, rays.names, numbers);
        sampler.Append(emitters.Frames(rays.names.emitter), rays, numbers, stream, 8, *batch,
                       weight);
      }
      ASSERT_EQ(batch->size, 1000);
      double mean = 0;
      int outside = 0;
      for (int k = 0; k < 1000; ++k) {
        const Vec3 d{batch->direction_x[k], batch->direction_y[k], batch->direction_z[k]};
        const Vec3 x{frame.x[0], frame.x[1], frame.x[2]}, z{frame.z[0], frame.z[1], frame.z[2]};
        outside += sampler.cells().Locate({Dot(d, x), Dot(d, Cross(z, x)), Dot(d, z)}) != p;
        mean += sampler.weighted() ? weight[k] / 1000.0 : 1e-3;
      }
      EXPECT_LE(outside, 1) << kind << " " << p;  // float32 at a border
      EXPECT_NEAR(mean, 1, 5 * 0.6 / std::sqrt(1000)) << kind << " " << p;
    }
  }
}

}  // namespace
}  // namespace lambert
