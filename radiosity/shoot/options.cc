#include "radiosity/shoot/options.h"

#include <cmath>

#include "radiosity/core/error.h"

namespace lambert {
namespace {

struct MethodEntry {
  Method method;
  const char* name;
};
constexpr MethodEntry kMethods[] = {
    {Method::kAuto, "auto"}, {Method::kPmcr, "pmcr"}, {Method::kPhs, "phs"}};

constexpr int kMaxPyramids = 65536;  // densities of a patch: 256 KiB

absl::Status FieldError(const std::string& field, const std::string& message,
                        const std::string& hint) {
  return MakeError(absl::StatusCode::kInvalidArgument, {"FIELD_INVALID", field, message, hint});
}

}  // namespace

const char* MethodName(Method method) {
  for (const MethodEntry& entry : kMethods) {
    if (entry.method == method) return entry.name;
  }
  return "unknown";
}

absl::StatusOr<Method> ParseMethod(const std::string& name) {
  std::string choices;
  for (const MethodEntry& entry : kMethods) {
    if (name == entry.name) return entry.method;
    choices += (choices.empty() ? "" : ", ") + std::string(entry.name);
  }
  return FieldError("method", "there is no method '" + name + "'", "choose one of " + choices);
}

std::vector<Method> AllMethods() {
  std::vector<Method> methods;
  for (const MethodEntry& entry : kMethods) {
    if (entry.method != Method::kAuto) methods.push_back(entry.method);
  }
  return methods;
}

absl::Status ShootOptions::Validate() const {
  const PyramidOptions& p = pyramids;
  if (p.initial < 3 || p.initial > 64) {
    return FieldError("phs-initial", std::to_string(p.initial) + " is not in 3..64",
                      "use 4 to start like the paper");
  }
  if (p.split != 3 && p.split != 4) {
    return FieldError("phs-split", std::to_string(p.split) + " is neither 3 nor 4",
                      "use 4 (edge midpoints) or 3 (centroid)");
  }
  if (p.depth < 0 || p.initial * std::pow(p.split, p.depth) > kMaxPyramids) {
    return FieldError("phs-depth", std::to_string(p.depth) + " gives too many or no pyramids",
                      "keep initial * split^depth at or under " + std::to_string(kMaxPyramids));
  }
  if (!(p.alpha1 >= 0) || !(p.alpha2 >= 0) || !(p.alpha1 + p.alpha2 > 0) ||
      !std::isfinite(p.alpha1 + p.alpha2)) {
    return FieldError("phs-alpha1, phs-alpha2", "the weights are negative, not finite or both zero",
                      "use 1 and 1 for the paper's density");
  }
  if (p.min_rays < 0) {
    return FieldError("phs-min-rays", std::to_string(p.min_rays) + " is negative",
                      "use 0 to let the planner choose");
  }
  return absl::OkStatus();
}

}  // namespace lambert
