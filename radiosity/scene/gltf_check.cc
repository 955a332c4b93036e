#include "radiosity/scene/gltf_check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "radiosity/core/error.h"
#include "radiosity/scene/gltf_container.h"
#include "radiosity/scene/gltf_relations.h"
#include "radiosity/scene/gltf_rules.h"

namespace lambert {
namespace {

using Json = nlohmann::json;

absl::Status Wrong(const std::string& where, const std::string& message) {
  return SceneError(where, message, "export the file again");
}

using RulesOfObjects = std::map<std::string, std::vector<const GltfRule*>>;
const RulesOfObjects& RulesByObject() {
  static const RulesOfObjects& rules = *[] {
    auto* by_object = new RulesOfObjects;
    for (const GltfRule& rule : GltfRules()) (*by_object)[rule.object].push_back(&rule);
    return by_object;
  }();
  return rules;
}

// The list of the file, or of its lights, that holds objects of a kind.
std::string ListOf(const std::string& object) {
  for (const GltfRule* rule : RulesByObject().at("glTF")) {
    if (rule->kind == GltfKind::kObjects && object == rule->target) return rule->property;
  }
  return "";
}

bool Contains(const Json& list, const std::string& text) {
  return std::find(list.begin(), list.end(), Json(text)) != list.end();
}

class Checker {
 public:
  explicit Checker(const Json& root)
      : root_(root), used_(root.value("extensionsUsed", Json::array())) {}

  // `where`: the object's own name, "" for the file.
  absl::Status CheckObject(const std::string& object, const Json& value,
                           const std::string& where) const {
    if (!value.is_object()) return Wrong(where, "it is not an object");
    if (const auto rules = RulesByObject().find(object); rules != RulesByObject().end()) {
      for (const GltfRule* rule : rules->second) {
        absl::Status status = CheckProperty(*rule, value, where);
        if (!status.ok()) return status;
      }
    }
    absl::Status status = CheckExtensions(object, value, where);
    return status.ok() ? CheckRelations(object, value, root_, where) : status;
  }

 private:
  static std::string Join(const std::string& where, const std::string& part) {
    return where.empty() ? part : absl::StrCat(where, ", ", part);
  }

  absl::Status CheckProperty(const GltfRule& rule, const Json& object,
                             const std::string& where) const {
    const auto found = object.find(rule.property);
    const std::string here = Join(where, rule.property);
    if (found == object.end()) {
      return rule.required ? Wrong(here, "it is missing") : absl::OkStatus();
    }
    switch (rule.kind) {
      case GltfKind::kObject:
        return CheckObject(rule.target, *found, here);
      case GltfKind::kIndexMap:
        return CheckIndexMap(rule, *found, here);
      case GltfKind::kObjects:
        return ForEach(*found, here, [&](const Json& item, size_t k) {
          return CheckObject(rule.target, item, Join(where, absl::StrCat(rule.target, " ", k)));
        });
      case GltfKind::kIndexMaps:
        return ForEach(*found, here,
                       [&](const Json& item, size_t) { return CheckIndexMap(rule, item, here); });
      case GltfKind::kIndices:
      case GltfKind::kTexts:
      case GltfKind::kNumbers:
        if (rule.count > 0 && found->is_array() && found->size() != size_t(rule.count)) {
          return Wrong(here, absl::StrCat("its length is ", found->size(), ", not ", rule.count));
        }
        return ForEach(*found, here,
                       [&](const Json& item, size_t) { return CheckValue(rule, item, here); });
      default:
        return CheckValue(rule, *found, here);
    }
  }

  template <typename Check>
  static absl::Status ForEach(const Json& list, const std::string& where, Check check) {
    if (!list.is_array()) return Wrong(where, "it is not an array");
    if (list.empty()) return Wrong(where, "it is empty");
    for (size_t k = 0; k < list.size(); ++k) {
      absl::Status status = check(list[k], k);
      if (!status.ok()) return status;
    }
    return absl::OkStatus();
  }

  absl::Status CheckIndexMap(const GltfRule& rule, const Json& map,
                             const std::string& where) const {
    if (!map.is_object()) return Wrong(where, "it is not an object");
    if (map.empty()) return Wrong(where, "it is empty");
    for (const auto& [name, index] : map.items()) {
      absl::Status status = CheckIndex(rule, index, Join(where, Printable(name)));
      if (!status.ok()) return status;
    }
    return absl::OkStatus();
  }

  absl::Status CheckIndex(const GltfRule& rule, const Json& value, const std::string& where) const {
    const Json* holder = &root_;
    std::string list = ListOf(rule.target);
    if (list.empty()) {  // the one kind of objects that an extension adds
      list = "lights";
      const auto at = Json::json_pointer("/extensions/KHR_lights_punctual");
      if (root_.contains(at)) holder = &root_[at];
    }
    const auto found = holder->find(list);
    const size_t size = found == holder->end() || !found->is_array() ? 0 : found->size();
    const double index = value.is_number() ? value.get<double>() : -1;
    if (index < 0 || index != std::floor(index)) return Wrong(where, "it is not an index");
    if (index < static_cast<double>(size)) return absl::OkStatus();
    return Wrong(where, absl::StrCat(rule.target, " ", index, " does not exist"));
  }

  absl::Status CheckValue(const GltfRule& rule, const Json& value, const std::string& where) const {
    switch (rule.kind) {
      case GltfKind::kIndex:
      case GltfKind::kIndices:
        return CheckIndex(rule, value, where);
      case GltfKind::kText:
      case GltfKind::kTexts:
        return value.is_string() ? absl::OkStatus() : Wrong(where, "it is not a string");
      case GltfKind::kBool:
        return value.is_boolean() ? absl::OkStatus() : Wrong(where, "it is neither true nor false");
      default:
        break;
    }
    if (!value.is_number()) return Wrong(where, "it is not a number");
    const double number = value.get<double>();
    if (!std::isfinite(number)) return Wrong(where, "it is not finite");
    if (rule.kind == GltfKind::kInteger && number != std::floor(number)) {
      return Wrong(where, absl::StrCat(number, " is not a whole number"));
    }
    if (number >= rule.least && number <= rule.most) return absl::OkStatus();
    return Wrong(where, number < rule.least ? absl::StrCat(number, " is under ", rule.least)
                                            : absl::StrCat(number, " is over ", rule.most));
  }

  absl::Status CheckExtensions(const std::string& object, const Json& value,
                               const std::string& where) const {
    const auto extensions = value.find("extensions");
    if (extensions == value.end()) return absl::OkStatus();
    const std::string here = Join(where, "extensions");
    if (!extensions->is_object()) return Wrong(here, "it is not an object");
    for (const auto& [name, content] : extensions->items()) {
      if (!Contains(used_, name)) {
        return Wrong(here, absl::StrCat(Printable(name), " is not named in extensionsUsed"));
      }
      absl::Status status = CheckExtension(object, name, content, here);
      if (!status.ok()) return status;
    }
    return absl::OkStatus();
  }

  absl::Status CheckExtension(const std::string& object, const std::string& name,
                              const Json& content, const std::string& where) const {
    bool is_known = false;
    for (const GltfPlace& place : GltfPlaces()) {
      if (name != place.extension) continue;
      if (object == place.object) return CheckObject(place.content, content, Join(where, name));
      is_known = true;
    }
    return is_known ? Wrong(where, name + " has no place here") : absl::OkStatus();
  }

  const Json& root_;
  const Json used_;
};

// The JSON, and whether an object in it has one key twice. Throws nothing.
Json Parse(absl::string_view text, bool* has_duplicates) {
  std::vector<std::set<std::string>> keys;  // of the objects that are open
  const auto see = [&](int, Json::parse_event_t event, Json& value) {
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key && !keys.back().insert(value.get<std::string>()).second) {
      *has_duplicates = true;
    }
    return true;
  };
  return Json::parse(text.begin(), text.end(), see, false);
}

bool IsOfAnotherVersion(const Json& root) {
  const Json asset = root.value("asset", Json());
  const Json version = asset.is_object() ? asset.value("version", Json()) : Json();
  return version.is_string() && !absl::StartsWith(version.get<std::string>(), "2.");
}

}  // namespace

absl::Status CheckGltf(absl::string_view text, std::vector<Warning>* warnings) {
  bool has_duplicates = false;
  const Json root = Parse(text, &has_duplicates);
  if (!root.is_object()) return Wrong("JSON", "it is not a glTF object");
  if (IsOfAnotherVersion(root)) return absl::OkStatus();
  absl::Status status = Checker(root).CheckObject("glTF", root, "");
  if (!status.ok()) return status;
  if (absl::StartsWith(text, "\xef\xbb\xbf")) {
    warnings->push_back({"JSON_BOM", "the file begins with a byte order mark: passed over"});
  }
  if (has_duplicates) {
    warnings->push_back({"JSON_DUPLICATE_KEY",
                         "an object of the file has one key twice: the last value was taken"});
  }
  const Json used = root.value("extensionsUsed", Json::array());
  for (const Json& name : root.value("extensionsRequired", Json::array())) {
    if (Contains(used, name)) continue;
    warnings->push_back(
        {"EXTENSION_REQUIRED_NOT_USED", absl::StrCat(Printable(name),
                                                     " is in extensionsRequired, but not in "
                                                     "extensionsUsed: taken as used")});
  }
  return absl::OkStatus();
}

}  // namespace lambert
