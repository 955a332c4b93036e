// Lights without a surface over a floor: what arrives at each patch is an integral of a closed
// form.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "radiosity/core/error.h"
#include "radiosity/patch/build_patches.h"
#include "radiosity/patch/light.h"
#include "radiosity/scene/sky_map.h"
#include "radiosity/shoot/importance.h"
#include "tests/analytic/seeds.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

constexpr int kDepth = 7;

// Mean of a function over a triangle, by its centroids after seven halvings of the edges.
double MeanOver(const std::array<Vec3, 3>& t, const std::function<double(Vec3)>& f,
                int depth = kDepth) {
  if (depth == 0) return f((t[0] + t[1] + t[2]) / 3);
  const Vec3 a = (t[0] + t[1]) / 2, b = (t[1] + t[2]) / 2, c = (t[2] + t[0]) / 2;
  return (MeanOver({t[0], a, c}, f, depth - 1) + MeanOver({a, t[1], b}, f, depth - 1) +
          MeanOver({c, b, t[2]}, f, depth - 1) + MeanOver({a, b, c}, f, depth - 1)) /
         4;
}

// 16 by 8 pixels, one of them lit, south-east and high; its colour is its own.
std::shared_ptr<const SphereTable> Hot() {
  SkyMap sky{16, 8, std::vector<float>(16 * 8 * 3)};
  const int pixel = 3 * (1 * 16 + 9);
  sky.rgb[pixel] = 3000;
  sky.rgb[pixel + 1] = 2000;
  sky.rgb[pixel + 2] = 500;
  for (int k = 2; k < 16 * 4 * 3; k += 3) sky.rgb[k] += 10;  // and a blue sky
  return *DecodeSkyMap("hot.exr", EncodeSkyMap(sky));
}

// A floor of 2 m by 2 m at height 0 that faces up, in eight patches.
SceneMaker Floor() {
  return SceneMaker().Quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, {{0.5, 0.5, 0.5}, {}}, 2);
}

// The illuminance at a point of the floor, world metres, in closed form.
using Closed = std::function<double(Vec3)>;

void ExpectIlluminance(const Scene& scene, const Closed& lux, int64_t rays = 200000) {
  const PatchSet patches = PatchesOf(scene);
  std::vector<Truth> truths;
  double most = 0;
  std::vector<double> means;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    means.push_back(MeanOver(patches.corners[i], [&](Vec3 p) { return lux(p + patches.origin); }));
    most = std::max(most, means.back());
  }
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    if (means[i] < most / 20) continue;  // too few rays to be sure of
    truths.push_back({"a patch of the floor", means[i],
                      [i](const Solution& s) { return s.irradiance_lx[i].r; }});
  }
  for (Method method : {Method::kPmcr, Method::kPhs}) {
    ExpectTruths(patches, WithRays(method, rays), truths);
  }
  const Solution exact = SolveSeeds(patches, WithRays(Method::kExact, 200000), 1)[0];
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    EXPECT_NEAR(exact.irradiance_lx[i].r, means[i], 2e-4 * most) << i;
  }
}

Scene WithLight(const Light& light) {
  Scene scene = Floor().Make();
  scene.lights.push_back(light);
  return scene;
}

// E = I cos / r2 = I h / r3
TEST(LightsOverAFloor, APointLight) {
  ExpectIlluminance(WithLight({"", {0.2, 1, 0.1}, {100, 50, 20}}), [](Vec3 p) {
    const double r = Length(Vec3{0.2, 1, 0.1} - p);
    return 100 / (r * r * r);
  });
}

// The same times ((cos - cos_outer) / (cos_inner - cos_outer))^2 in the rim.
TEST(LightsOverAFloor, ASpotStraightDown) {
  Light light{"", {0, 1, 0}, {100, 50, 20}};
  light.x = {1, 0, 0};
  light.y = {0, 0, 1};
  light.z = {0, -1, 0};
  light.cos_inner = 0.9;
  light.cos_outer = 0.6;
  ExpectIlluminance(WithLight(light), [](Vec3 p) {
    const double r = Length(Vec3{0, 1, 0} - p), cosine = 1 / r;
    const double part = std::clamp((cosine - 0.6) / 0.3, 0.0, 1.0);
    return 100 * part * part / (r * r * r);
  });
}

TEST(LightsOverAFloor, ASpotAskew) {
  Light light{"", {-0.5, 1, 0}, {100, 50, 20}};
  light.x = {0, 0, 1};
  light.y = {0.8, 0.6, 0};
  light.z = {0.6, -0.8, 0};
  light.cos_inner = 0.95;
  light.cos_outer = 0.7;
  ExpectIlluminance(WithLight(light), [](Vec3 p) {
    const Vec3 way = p - Vec3{-0.5, 1, 0};
    const double r = Length(way), cosine = Dot(way, {0.6, -0.8, 0}) / r;
    const double part = std::clamp((cosine - 0.7) / 0.25, 0.0, 1.0);
    return 100 * part * part / (r * r * r);
  });
}

// E cos theta
TEST(LightsOverAFloor, ADistantLight) {
  Light light{"", {}, {100, 50, 20}, Light::Kind::kDistant};
  light.z = {0.6, -0.8, 0};
  ExpectIlluminance(WithLight(light), [](Vec3) { return 80; });
}

// What a box hides of the floor is dark, and what enters the box around the scene and meets nothing
// escapes: the ledger says so.
TEST(LightsOverAFloor, ADistantLightCastsAShadow) {
  Scene scene = Floor().Quad({-1, 1, -1}, {0, 0, 2}, {1, 0, 0}, {{}, {}, true}).Make();
  Light light{"", {}, {100, 100, 100}, Light::Kind::kDistant};
  light.z = {0, -1, 0};
  scene.lights.push_back(light);
  const PatchSet patches = PatchesOf(scene);
  const Solution solution = SolveSeeds(patches, WithRays(Method::kPmcr, 200000), 1)[0];
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    if (patches.source[i].node != 0) continue;
    const bool dark = PatchCentroid(patches, i).x + patches.origin.x < 0;
    EXPECT_NEAR(solution.irradiance_lx[i].r, dark ? 0 : 100, dark ? 0.5 : 5) << i;
  }
  EXPECT_NEAR(solution.ledger.emitted.r, 400, 1e-9);
}

// Radiosities of a sky or a sun over an open floor: a plane has E = pi L of a uniform sky, 7/9 pi
// L_z of an overcast one, whatever the method.
PatchSet FloorUnder(const LightOptions& lights) {
  PatchOptions options;
  options.lights = lights;
  Scene scene = Floor().Make();
  scene.skies["hot.exr"] = Hot();
  auto patches = BuildPatches(scene, options);
  EXPECT_TRUE(patches.ok()) << patches.status();
  return *std::move(patches);
}

double FloorMean(const PatchSet& patches, const Solution& s) {
  return AreaMean(patches, s.irradiance_lx);
}

TEST(OpenFloor, HasTheIlluminanceOfItsSky) {
  for (const char* sky : {"uniform", "overcast"}) {
    const PatchSet patches = FloorUnder({.sky = sky, .sky_illuminance_lx = 300});
    for (Method method : {Method::kPmcr, Method::kPhs}) {
      ExpectTruths(patches, WithRays(method, 200000),
                   {{sky, 300, [&](const Solution& s) { return FloorMean(patches, s); }}});
    }
  }
}

// A box without a lid under a uniform sky of luminance L, whose walls emit (1 - rho) pi L: wherever
// a patch looks it sees L, so pi L arrives at each and leaves each.
TEST(FurnaceUnderASky, EveryPatchSeesTheSameAllAround) {
  constexpr double kRho = 0.6, kSky_lx = 300, kOwn = (1 - kRho) * kSky_lx;
  const Paint paint{{kRho, kRho, kRho}, {kOwn, kOwn, kOwn}};
  const Scene scene = SceneMaker()
                          .Quad({}, {0, 0, 1}, {1, 0, 0}, paint)
                          .Quad({}, {0, 1, 0}, {0, 0, 1}, paint)
                          .Quad({1, 0, 0}, {0, 0, 1}, {0, 1, 0}, paint)
                          .Quad({}, {1, 0, 0}, {0, 1, 0}, paint)
                          .Quad({0, 0, 1}, {0, 1, 0}, {1, 0, 0}, paint)
                          .Make();
  PatchOptions options;
  options.lights = {.sky = "uniform", .sky_illuminance_lx = kSky_lx};
  const absl::StatusOr<PatchSet> patches = BuildPatches(scene, options);
  ASSERT_TRUE(patches.ok()) << patches.status();
  std::vector<Truth> truths;
  for (PatchIndex i = 0; i < patches->size(); ++i) {
    truths.push_back({"irradiance of a patch", kSky_lx,
                      [i](const Solution& s) { return s.irradiance_lx[i].r; }});
  }
  truths.push_back({"mean radiosity", kSky_lx,
                    [&](const Solution& s) { return AreaMean(*patches, s.radiosity_lm_per_m2); }});
  for (Method method : {Method::kPmcr, Method::kPhs}) {
    ExpectTruths(*patches, WithRays(method, 400000), truths);
  }
  const absl::Status refused = ValidateFor(*patches, WithRays(Method::kExact, 1).shoot);
  EXPECT_EQ(ReasonOf(refused), "FIELD_INVALID");
  EXPECT_NE(refused.message().find("exact does not take a sky"), std::string::npos) << refused;
}

TEST(OpenFloor, OfASunHasTheSineOfItsElevation) {
  const PatchSet patches =
      FloorUnder({.sun_azimuth_deg = 200, .sun_elevation_deg = 30, .sun_illuminance_lx = 1000});
  ExpectTruths(patches, WithRays(Method::kPmcr, 100000),
               {{"sun", 500, [&](const Solution& s) { return FloorMean(patches, s); }}});
}

// One pixel is lit: a sun of its solid angle. Each channel keeps its own flux.
TEST(OpenFloor, OfASkyWithOneHotPixelIsLitByIt) {
  const PatchSet patches = FloorUnder({.sky = "hot.exr"});
  const Rgb truth = Hot()->CosineTotal();
  std::vector<Truth> truths;
  for (int c = 0; c < 3; ++c) {
    truths.push_back({"hot pixel", truth[c], [&patches, c](const Solution& s) {
                        double sum = 0;
                        for (const Rgb& lx : s.irradiance_lx) sum += lx[c];
                        return sum / patches.size();  // patches of equal area
                      }});
  }
  ExpectTruths(patches, WithRays(Method::kPmcr, 200000), truths);
}

// A black box with an opening in its lid, under a uniform sky: the mean over the floor is the form
// factor from the floor to the opening, here two equal parallel squares, 2 m by 2 m and 2 m apart.
TEST(DaylightFactor, UnderAnOpeningIsAFormFactor) {
  Scene scene = SceneMaker()
                    .Quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, {{}, {}}, 2)
                    .Quad({-1, 0, -1}, {2, 0, 0}, {0, 2, 0}, {{}, {}, true})
                    .Quad({-1, 0, 1}, {2, 0, 0}, {0, 2, 0}, {{}, {}, true})
                    .Quad({-1, 0, -1}, {0, 0, 2}, {0, 2, 0}, {{}, {}, true})
                    .Quad({1, 0, -1}, {0, 0, 2}, {0, 2, 0}, {{}, {}, true})
                    .Make();
  PatchOptions options;
  options.lights = {.sky = "uniform", .sky_illuminance_lx = 1000};
  const PatchSet patches = *BuildPatches(scene, options);
  const double factor = 0.19982489569838746;  // Howell C-11 for X = Y = 1
  const auto floor = [&](const Solution& s) {
    double sum = 0, area = 0;
    for (PatchIndex i = 0; i < patches.size(); ++i) {
      if (patches.source[i].node != 0) continue;
      sum += s.irradiance_lx[i].r * patches.area_m2[i];
      area += patches.area_m2[i];
    }
    return sum / area;
  };
  ExpectTruths(patches, WithRays(Method::kPmcr, 400000), {{"floor", 1000 * factor, floor}});
}

// A lamp of 100 cd all around equals a point light; a cosine lamp has E = I cos^4 / h^2.
TEST(LampsOverAFloor, AreWhatTheirTablesSay) {
  Light lamp{"", {0.2, 1, 0.1}, {1, 1, 1}, Light::Kind::kLamp};
  lamp.x = {1, 0, 0};
  lamp.y = {0, 0, 1};
  lamp.z = {0, -1, 0};
  lamp.table = *SphereTable::Create({true, 1, {-1, 1}, {0, 1}, {100, 100, 100, 100}});
  constexpr int64_t kRays = 400000;
  const auto all_around = [](Vec3 p) {
    const double r = Length(Vec3{0.2, 1, 0.1} - p);
    return 100 / (r * r * r);
  };
  ExpectIlluminance(WithLight(lamp), all_around, kRays);
  // Linear in z: the cosine itself.
  lamp.table = *SphereTable::Create({true, 1, {0, 1}, {0, 1}, {0, 0, 100, 100}});
  const auto cosine = [](Vec3 p) {
    const double r = Length(Vec3{0.2, 1, 0.1} - p);
    return 100 / (r * r * r * r);
  };
  ExpectIlluminance(WithLight(lamp), cosine, kRays);
}

}  // namespace
}  // namespace lambert
