#include <gtest/gtest.h>

#include <thread>

#include "radiosity/trace/ray_scene.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace lambert {
namespace {

struct Ray {
  Vec3 origin, direction;
};

// Rays from anywhere in the box of trace coordinates, in any direction.
std::vector<Ray> RandomRays(int count) {
  TestRandom random(1);
  std::vector<Ray> rays(count);
  for (Ray& ray : rays) {
    ray.origin = {random.Uniform(-0.3, 0.3), random.Uniform(-0.2, 0.2), random.Uniform(-0.4, 0.4)};
    ray.direction = random.Direction();
  }
  return rays;
}

void Put(const Ray& ray, RayBatch& batch) {
  const int k = batch.size++;
  batch.origin_x[k] = static_cast<float>(ray.origin.x);
  batch.origin_y[k] = static_cast<float>(ray.origin.y);
  batch.origin_z[k] = static_cast<float>(ray.origin.z);
  batch.direction_x[k] = static_cast<float>(ray.direction.x);
  batch.direction_y[k] = static_cast<float>(ray.direction.y);
  batch.direction_z[k] = static_cast<float>(ray.direction.z);
}

// Hits of the rays in batches of `width`.
std::vector<PatchIndex> Trace(const RayScene& scene, const std::vector<Ray>& rays, int width) {
  auto batch = std::make_unique<RayBatch>();
  std::vector<PatchIndex> hits;
  for (size_t k = 0; k < rays.size(); ++k) {
    Put(rays[k], *batch);
    if (batch->size < width && k + 1 < rays.size()) continue;
    scene.Trace(*batch);
    hits.insert(hits.end(), batch->hit, batch->hit + batch->size);
    batch->size = 0;
  }
  return hits;
}

TEST(Trace, AnswersARayAlikeAmongAnyNeighboursAndAtAnyPlace) {
  const PatchSet patches = PatchesOf(MakeOffice(2));
  const auto scene = *RayScene::Create(patches);
  const std::vector<Ray> rays = RandomRays(20000);
  const std::vector<PatchIndex> hits = Trace(*scene, rays, RayBatch::kCapacity);
  EXPECT_GT(std::count_if(hits.begin(), hits.end(), [](PatchIndex i) { return i >= 0; }), 15000);
  for (int width : {1, 3, 8, 9, 500}) EXPECT_EQ(Trace(*scene, rays, width), hits) << width;

  std::vector<size_t> order(rays.size());
  TestRandom random(2);
  for (size_t k = 0; k < order.size(); ++k) {
    order[k] = k;
    std::swap(order[k], order[random.Below(static_cast<int64_t>(k) + 1)]);
  }
  std::vector<Ray> shuffled;
  for (size_t k : order) shuffled.push_back(rays[k]);
  const std::vector<PatchIndex> again = Trace(*scene, shuffled, RayBatch::kCapacity);
  for (size_t k = 0; k < order.size(); ++k) ASSERT_EQ(again[k], hits[order[k]]);
}

TEST(Trace, AnswersOfScenesBuiltTwiceAndOfThreadsAtOnceAreEqual) {
  const PatchSet patches = PatchesOf(MakeOffice(2));
  const std::vector<Ray> rays = RandomRays(20000);
  const auto first = *RayScene::Create(patches), second = *RayScene::Create(patches);
  const std::vector<PatchIndex> hits = Trace(*first, rays, RayBatch::kCapacity);
  std::vector<std::vector<PatchIndex>> answers(4);
  std::vector<std::thread> threads;
  for (auto& answer : answers) {
    threads.emplace_back([&] { answer = Trace(*second, rays, RayBatch::kCapacity); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& answer : answers) EXPECT_EQ(answer, hits);
}

TEST(Trace, TakesDirectionsOfAnyLength) {
  const PatchSet patches = PatchesOf(MakeOffice(2));
  const auto scene = *RayScene::Create(patches);
  const std::vector<Ray> rays = RandomRays(5000);
  const std::vector<PatchIndex> hits = Trace(*scene, rays, RayBatch::kCapacity);
  for (double length : {0x1p-20, 0x1p20}) {
    std::vector<Ray> longer = rays;
    for (Ray& ray : longer) ray.direction = ray.direction * length;
    EXPECT_EQ(Trace(*scene, longer, RayBatch::kCapacity), hits) << length;
  }
}

// Every triangle tried in double (Moeller, Trumbore 1997): the nearest patch, or kEscaped behind
// the back of a one-sided one. Of a front and a back in one plane, the front.
PatchIndex NearestSide(const PatchSet& patches, Vec3 origin, Vec3 direction, double* margin) {
  PatchIndex nearest = kEscaped;
  double distance = 1e300;
  *margin = 1;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const auto& [a, b, c] = patches.corners[i];
    const Vec3 e1 = b - a, e2 = c - a, p = Cross(direction, e2);
    const double determinant = Dot(e1, p);
    if (determinant == 0) continue;  // seen along its plane
    const Vec3 s = origin - a, q = Cross(s, e1);
    const double u = Dot(s, p) / determinant, v = Dot(direction, q) / determinant;
    const double t = Dot(e2, q) / determinant;
    const double inside = std::min({u, v, 1 - u - v});
    if (t > 0 && t < distance + 1e-3) *margin = std::min(*margin, std::abs(inside));
    const bool back = determinant < 0;
    if (inside < 0 || t <= 0 || t >= distance + (back ? -1e-6 : 1e-6)) continue;
    nearest = back ? kEscaped : i;
    distance = t;
  }
  return nearest;
}

TEST(Trace, HitsTheNearestSideOfAllTriangles) {
  const PatchSet patches = PatchesOf(MakeOffice(1));
  const auto scene = *RayScene::Create(patches);
  const std::vector<Ray> rays = RandomRays(10000);
  const std::vector<PatchIndex> hits = Trace(*scene, rays, RayBatch::kCapacity);
  const Vec3 zero = scene->ToTrace({});
  int compared = 0;
  for (size_t k = 0; k < rays.size(); ++k) {
    double margin;
    const Vec3 origin = (rays[k].origin - zero) / scene->scale();
    const PatchIndex expected = NearestSide(patches, origin, rays[k].direction, &margin);
    if (margin < 1e-4) continue;  // so near to an edge that float may see the other side
    ++compared;
    ASSERT_EQ(hits[k], expected) << k;
  }
  EXPECT_GT(compared, 9000);
}

TEST(TracerPins, NameTheLibraryTheInstructionSetAndTheTraversal) {
  for (const char* pin : {"embree-3.", "avx2", "robust", "medium"}) {
    EXPECT_NE(TracerPins().find(pin), std::string::npos) << pin;
  }
}

}  // namespace
}  // namespace lambert
