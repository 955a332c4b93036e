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
    {Method::kAuto, "auto"},          {Method::kMcr, "mcr"},
    {Method::kPmcr, "pmcr"},          {Method::kHs97, "hs97"},
    {Method::kHs98, "hs98"},          {Method::kPhs, "phs"},
    {Method::kPhsAlpha, "phs-alpha"}, {Method::kPhsAdaptive, "phs-adaptive"},
    {Method::kPhsHier, "phs-hier"},   {Method::kImportance, "importance"},
    {Method::kWalk, "walk"},          {Method::kExact, "exact"}};

constexpr int kMaxPyramids = 65536;  // densities of a patch: 256 KiB

absl::Status FieldError(const std::string& field, const std::string& message,
                        const std::string& hint) {
  return MakeError(absl::StatusCode::kInvalidArgument, {"FIELD_INVALID", field, message, hint});
}

absl::Status CheckCells(const PyramidOptions& p) {
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
  if (p.grid < 1 || p.grid > 64) {
    return FieldError("phs-grid", std::to_string(p.grid) + " is not in 1..64",
                      "use 8 for 64 squares");
  }
  if (p.leaves < p.initial || p.leaves > kMaxPyramids) {
    return FieldError(
        "phs-leaves",
        std::to_string(p.leaves) + " is under phs-initial or over " + std::to_string(kMaxPyramids),
        "use 64");
  }
  return absl::OkStatus();
}

absl::Status CheckDensities(const PyramidOptions& p) {
  if (!(p.metric >= 0) || !(p.metric <= 1)) {
    return FieldError("phs-metric", "it is not in 0..1",
                      "use 0 for the unweighted error, 1 for the area-weighted one");
  }
  if (!(p.alpha1 >= 0) || !(p.alpha2 >= 0) || !(p.alpha1 + p.alpha2 > 0) ||
      !std::isfinite(p.alpha1 + p.alpha2)) {
    return FieldError("phs-alpha1, phs-alpha2", "the weights are negative, not finite or both zero",
                      "use 1 and 1 for the paper's density");
  }
  if (p.probes < 1 || p.probes > 4096) {
    return FieldError("phs-probes", std::to_string(p.probes) + " is not in 1..4096", "use 4");
  }
  if (!(p.hier_flux >= 0)) {
    return FieldError("phs-hier-flux", "it is negative", "use 0.05, or 0 for no hierarchy");
  }
  if (!(p.hier_size >= 0)) {
    return FieldError("phs-hier-size", "it is negative", "use 0.3");
  }
  if (p.min_rays < 0) {
    return FieldError("phs-min-rays", std::to_string(p.min_rays) + " is negative",
                      "use 0 to let the planner choose");
  }
  return absl::OkStatus();
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

bool UsesPyramids(Method method) {
  return method != Method::kAuto && method != Method::kMcr && method != Method::kPmcr &&
         method != Method::kWalk && method != Method::kExact;
}

int PyramidOptions::CellCount() const {
  if (cells == CellShape::kSquare) return grid * grid;
  int count = initial;
  for (int k = 0; k < depth; ++k) count *= split;
  return count;
}

absl::Status ShootOptions::Validate() const {
  if (absl::Status status = CheckCells(pyramids); !status.ok()) return status;
  if (absl::Status status = CheckDensities(pyramids); !status.ok()) return status;
  if (const PartSet both = parts.with & parts.without; both != PartSet()) {
    return FieldError("with, without", both.Text() + " stands in both", "name it in one of them");
  }
  if (method == Method::kImportance && region.empty()) {
    return FieldError("region", "the method importance needs to know what is important",
                      "name a node with --region");
  }
  if (method == Method::kPhsAdaptive && pyramids.cells != CellShape::kTriangle) {
    return FieldError("phs-cells", "the method phs-adaptive splits spherical triangles only",
                      "use --phs-cells triangles");
  }
  if (pyramids.cells == CellShape::kSquare && pyramids.sampling == PyramidSampling::kSolidAngle) {
    return FieldError("phs-sampling", "squares are cells of equal projected solid angle",
                      "use --phs-sampling projected");
  }
  return absl::OkStatus();
}

absl::Status ShootOptions::ValidateFor(int64_t patches) const {
  if (absl::Status status = Validate(); !status.ok()) return status;
  if (method != Method::kExact || patches <= kMaxExactPatches) return absl::OkStatus();
  return FieldError("method",
                    "exact takes at most " + std::to_string(kMaxExactPatches) +
                        " patches and the scene has " + std::to_string(patches),
                    "use a larger --max-edge or another method");
}

}  // namespace lambert
