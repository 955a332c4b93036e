#include "tests/analytic/methods.h"

#include <gtest/gtest.h>

#include "radiosity/shoot/settings.h"

namespace lambert {

std::vector<MethodCase> EveryShootingMethod() {
  return {{"mcr", Method::kMcr, {}},
          {"pmcr", Method::kPmcr, {}},
          {"pmcr of Sobol points", Method::kPmcr, {{"sequence", "sobol"}}},
          {"pmcr, rays by variance", Method::kPmcr, {{"allocation", "variance"}}},
          {"hs97", Method::kHs97, {{"phs-probes", "1"}}},
          {"hs98", Method::kHs98, {}},
          {"hs98 by variance, squares",
           Method::kHs98,
           {{"phs-rule", "variance"}, {"phs-cells", "squares"}, {"phs-alpha1", "0.1"}}},
          {"phs", Method::kPhs, {}},
          {"phs, weighted rays", Method::kPhs, {{"phs-sampling", "solid-angle"}}},
          {"phs by variance, squares of Sobol points",
           Method::kPhs,
           {{"phs-rule", "variance"},
            {"phs-cells", "squares"},
            {"phs-metric", "1"},
            {"phs-alpha1", "0.1"},
            {"sequence", "sobol"}}},
          {"phs-alpha", Method::kPhsAlpha, {}},
          {"phs-alpha with the unseen", Method::kPhsAlpha, {{"phs-count-unseen", "yes"}}},
          {"phs-adaptive", Method::kPhsAdaptive, {{"phs-leaves", "16"}, {"phs-depth", "3"}}},
          {"phs-hier", Method::kPhsHier, {}},
          {"phs-hier with densities of elements",
           Method::kPhsHier,
           {{"phs-hier-densities", "yes"}, {"phs-min-rays", "100"}}},
          {"importance", Method::kImportance, {}}};
}

std::vector<MethodCase> EveryWalk() {
  return {{"walk", Method::kWalk, {}},
          {"walk that begins at Sobol points", Method::kWalk, {{"sequence", "sobol"}}}};
}

SolveOptions OptionsOf(const MethodCase& method, int64_t rays, int64_t min_rays) {
  SolveOptions options;
  options.shoot.method = method.method;
  options.shoot.pyramids.min_rays = min_rays;
  options.max_rays = rays;
  for (const auto& [name, text] : method.settings) {
    EXPECT_TRUE(ApplySetting(name, text, options.shoot).ok()) << name;
  }
  if (method.method == Method::kImportance) options.shoot.region = {"0"};
  return options;
}

}  // namespace lambert
