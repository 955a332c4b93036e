#include "radiosity/scene/unread_features.h"

#include "absl/strings/str_cat.h"

namespace lambert {

void UnreadFeatures::Add(const std::string& feature, const std::string& unit,
                         const std::string& consequence) {
  Entry& entry = entries_[feature];
  entry.unit = unit;
  entry.consequence = consequence;
  ++entry.count;
}

std::vector<Warning> UnreadFeatures::Warnings() const {
  std::vector<Warning> warnings;
  for (const auto& [feature, entry] : entries_) {
    warnings.push_back(
        {"FEATURE_NOT_READ", absl::StrCat(feature, " (", entry.count, " ", entry.unit,
                                          entry.count == 1 ? "" : "s", "): ", entry.consequence)});
  }
  return warnings;
}

}  // namespace lambert
