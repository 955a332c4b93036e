#include "radiosity/shoot/settings.h"

#include <charconv>
#include <cmath>

#include "radiosity/core/error.h"

namespace lambert {
namespace {

template <typename Number>
std::string NumberText(Number value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof(text), value).ptr;
  return {text, end};
}

template <typename Number>
bool ReadNumber(const std::string& text, Number& number) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(static_cast<double>(value)))
    return false;
  number = value;
  return true;
}

template <auto Member>
ShootSetting NumberSetting(const char* name, const char* value_name, const char* help) {
  return {name, value_name, help,
          [](const ShootOptions& o) { return NumberText(o.pyramids.*Member); },
          [](const std::string& text, ShootOptions& o) {
            return ReadNumber(text, o.pyramids.*Member);
          }};
}

template <auto Member>
ShootSetting FlagSetting(const char* name, const char* help) {
  return {name, "yes|no", help,
          [](const ShootOptions& o) { return std::string(o.pyramids.*Member ? "yes" : "no"); },
          [](const std::string& text, ShootOptions& o) {
            if (text != "yes" && text != "no") return false;
            o.pyramids.*Member = text == "yes";
            return true;
          }};
}

// Names of the values 0, 1, ... of an enumeration.
template <size_t N>
struct Names {
  const char* names[N];
};
constexpr Names<2> kShapes{{"triangles", "squares"}};
constexpr Names<2> kRules{{"count", "variance"}};
constexpr Names<2> kSamplings{{"solid-angle", "projected"}};
constexpr Names<2> kSequences{{"random", "sobol"}};
constexpr Names<2> kAllocations{{"flux", "variance"}};

template <const auto& kNames, typename Get>
ShootSetting ChoiceSetting(const char* name, const char* choices, const char* help, Get) {
  // `Get` is a captureless function from options to the field, const or not.
  return {
      name, choices, help,
      [](const ShootOptions& o) {
        return std::string(kNames.names[static_cast<size_t>(Get{}(const_cast<ShootOptions&>(o)))]);
      },
      [](const std::string& text, ShootOptions& o) {
        for (size_t k = 0; k < std::size(kNames.names); ++k) {
          if (text != kNames.names[k]) continue;
          auto& field = Get{}(o);
          field = static_cast<std::remove_reference_t<decltype(field)>>(k);
          return true;
        }
        return false;
      }};
}

const char* PartChoices() {
  static const std::string choices = [] {
    std::string names;
    for (Part part : AllParts()) names += (names.empty() ? "" : "|") + std::string(PartName(part));
    return names + ",...";
  }();
  return choices.c_str();
}

template <auto Member>
ShootSetting PartSetting(const char* name, const char* help) {
  return {name, PartChoices(), help, [](const ShootOptions& o) { return (o.parts.*Member).Text(); },
          [](const std::string& text, ShootOptions& o) { return (o.parts.*Member).Read(text); }};
}

std::vector<ShootSetting> MakeSettings() {
  using P = PyramidOptions;
  return {
      PartSetting<&Parts::with>("with", "parts that are done though the plan would not (none)"),
      PartSetting<&Parts::without>("without", "parts that are left out (none)"),
      ChoiceSetting<kSequences>(
          "sequence", "random|sobol",
          "numbers of the rays: random, or sobol, spread evenly (random)",
          [](ShootOptions & o) -> auto& { return o.sequence; }),
      ChoiceSetting<kAllocations>(
          "allocation", "flux|variance",
          "rays of a patch: by its flux, or so that the error is least (flux)",
          [](ShootOptions & o) -> auto& { return o.allocation; }),
      ChoiceSetting<kShapes>(
          "phs-cells", "triangles|squares",
          "parts of the hemisphere: the paper's triangles, or squares of equal "
          "projected solid angle (triangles)",
          [](ShootOptions & o) -> auto& { return o.pyramids.cells; }),
      NumberSetting<&P::initial>("phs-initial", "N",
                                 "spherical triangles to begin with, 3..64 (4)"),
      NumberSetting<&P::split>("phs-split", "3|4",
                               "children of a split: 4 (edge midpoints) or 3 (centroid) (4)"),
      NumberSetting<&P::depth>("phs-depth", "N", "how often triangles are split, 0..4 (2)"),
      NumberSetting<&P::grid>("phs-grid", "N", "squares along a side, 1..64 (8)"),
      NumberSetting<&P::leaves>("phs-leaves", "N", "phs-adaptive: pyramids of a patch (64)"),
      NumberSetting<&P::hier_flux>("phs-hier-flux", "F",
                                   "phs-hier: rays of a step from element to element, at most; "
                                   "fewer: larger elements (0.05)"),
      NumberSetting<&P::hier_size>(
          "phs-hier-size", "F",
          "phs-hier: radius of an element over the length of a ray to it, at most (0.3)"),
      FlagSetting<&P::hier_densities>(
          "phs-hier-densities", "phs-hier: patches of few rays share an element's densities (no)"),
      ChoiceSetting<kRules>(
          "phs-rule", "count|variance",
          "densities from the count of patches (the paper), or of least variance (count)",
          [](ShootOptions & o) -> auto& { return o.pyramids.rule; }),
      NumberSetting<&P::metric>(
          "phs-metric", "F",
          "of the variance rule: 0 for the unweighted error .. 1 for the area-weighted one (0)"),
      NumberSetting<&P::alpha1>("phs-alpha1", "F", "weight of the form factor in the density (1)"),
      NumberSetting<&P::alpha2>("phs-alpha2", "F", "weight of the rule in the density (1)"),
      ChoiceSetting<kSamplings>(
          "phs-sampling", "projected|solid-angle",
          "in a triangle: projected, all rays alike, or solid-angle, the paper's (projected)",
          [](ShootOptions & o) -> auto& { return o.pyramids.sampling; }),
      NumberSetting<&P::probes>("phs-probes", "N", "hs97, hs98: probing rays for each part (4)"),
      NumberSetting<&P::min_rays>(
          "phs-min-rays", "N",
          "rays in one visit from which a patch gets densities; 0: chosen by cost (0)"),
      FlagSetting<&P::count_unseen>("phs-count-unseen",
                                    "phs-alpha: estimate the patches that were not hit yet (no)"),
  };
}

}  // namespace

const std::vector<ShootSetting>& ShootSettings() {
  static const std::vector<ShootSetting> settings = MakeSettings();
  return settings;
}

absl::Status ApplySetting(const std::string& name, const std::string& text, ShootOptions& options) {
  std::string choices;
  for (const ShootSetting& setting : ShootSettings()) {
    if (name != setting.name) {
      choices += (choices.empty() ? "" : ", ") + std::string(setting.name);
      continue;
    }
    if (setting.set(text, options)) return absl::OkStatus();
    return MakeError(
        absl::StatusCode::kInvalidArgument,
        {"FIELD_INVALID", name, "'" + text + "' is not " + setting.value_name, setting.help});
  }
  return MakeError(absl::StatusCode::kInvalidArgument,
                   {"FIELD_INVALID", "settings", "there is no setting '" + name + "'",
                    "choose one of " + choices});
}

std::map<std::string, std::string> ChangedSettings(const ShootOptions& options) {
  const ShootOptions defaults;
  std::map<std::string, std::string> changed;
  for (const ShootSetting& setting : ShootSettings()) {
    const std::string text = setting.get(options);
    if (text != setting.get(defaults)) changed[setting.name] = text;
  }
  return changed;
}

}  // namespace lambert
