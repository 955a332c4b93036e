#include "radiosity/scene/gltf_relations.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/strip.h"
#include "radiosity/core/error.h"
#include "radiosity/scene/gltf_container.h"

namespace lambert {
namespace {

using Json = nlohmann::json;

absl::Status Wrong(const std::string& where, const std::string& message) {
  return SceneError(where, message, "export the file again");
}

double NumberOr(const Json& object, const char* property, double absent) {
  const auto found = object.find(property);
  return found == object.end() ? absent : found->get<double>();
}

absl::Status CheckAccessor(const Json& accessor, const Json&, const std::string& where) {
  constexpr double kUnsignedInt = 5125, kFloat = 5126;
  if (accessor.contains("byteOffset") && !accessor.contains("bufferView")) {
    return Wrong(where, "it has a byteOffset, but no bufferView");
  }
  const double type = accessor["componentType"].get<double>();
  if (accessor.value("normalized", false) && (type == kUnsignedInt || type == kFloat)) {
    return Wrong(where, "only integers of 8 and 16 bits can be normalized");
  }
  return absl::OkStatus();
}

absl::Status CheckBufferView(const Json& view, const Json& root, const std::string& where) {
  const Json& buffer = root["buffers"][static_cast<size_t>(view["buffer"].get<double>())];
  const double size = buffer["byteLength"].get<double>();
  if (NumberOr(view, "byteOffset", 0) + view["byteLength"].get<double>() <= size) {
    return absl::OkStatus();
  }
  return Wrong(where, absl::StrCat("it runs past the ", size, " bytes of its buffer"));
}

absl::Status CheckNode(const Json& node, const Json&, const std::string& where) {
  // Of the squared length: what rotations of 8 bits a component reach.
  constexpr double kLengthTolerance = 0.0154;
  if (node.contains("matrix")) {
    for (const char* part : {"translation", "rotation", "scale"}) {
      if (node.contains(part)) return Wrong(where, absl::StrCat("it has a matrix and a ", part));
    }
  }
  for (const char* part : {"skin", "weights"}) {
    if (node.contains(part) && !node.contains("mesh")) {
      return Wrong(where, absl::StrCat("it has ", part, ", but no mesh"));
    }
  }
  if (const auto rotation = node.find("rotation"); rotation != node.end()) {
    double squares = 0;
    for (const Json& x : *rotation) squares += x.get<double>() * x.get<double>();
    if (std::fabs(squares - 1) > kLengthTolerance) {
      return Wrong(where, absl::StrCat("its rotation has length ", std::sqrt(squares), ", not 1"));
    }
  }
  return absl::OkStatus();
}

absl::Status CheckCamera(const Json& camera, const Json&, const std::string& where) {
  const std::string type = camera["type"];
  for (const char* lens : {"perspective", "orthographic"}) {
    if (camera.contains(lens) != (type == lens)) {
      return Wrong(where,
                   absl::StrCat("its type \"", Printable(type), "\" does not suit its lens"));
    }
  }
  return absl::OkStatus();
}

absl::Status CheckLens(const Json& lens, const Json&, const std::string& where) {
  const double znear = lens["znear"].get<double>();
  if (NumberOr(lens, "zfar", std::numeric_limits<double>::infinity()) <= znear) {
    return Wrong(where, "its zfar is not beyond its znear");
  }
  if (NumberOr(lens, "xmag", 1) == 0 || NumberOr(lens, "ymag", 1) == 0) {
    return Wrong(where, "its xmag or ymag is 0");
  }
  return absl::OkStatus();
}

absl::Status CheckLight(const Json& light, const Json&, const std::string& where) {
  const std::string type = light["type"];
  if (type != "point" && type != "spot" && type != "directional") {
    return Wrong(where, absl::StrCat("its type \"", Printable(type), "\" does not exist"));
  }
  if ((type == "spot") == light.contains("spot")) return absl::OkStatus();
  return Wrong(where, type == "spot" ? "a spot light needs spot" : "only a spot light has spot");
}

absl::Status CheckSpot(const Json& spot, const Json&, const std::string& where) {
  constexpr double kQuarterPi = 0.7853981633974483;
  if (NumberOr(spot, "innerConeAngle", 0) < NumberOr(spot, "outerConeAngle", kQuarterPi)) {
    return absl::OkStatus();
  }
  return Wrong(where, "its innerConeAngle is not under its outerConeAngle");
}

bool IsAttribute(const std::string& name) {
  if (name == "POSITION" || name == "NORMAL" || name == "TANGENT") return true;
  if (absl::StartsWith(name, "_")) return true;
  for (const char* prefix : {"TEXCOORD_", "COLOR_", "JOINTS_", "WEIGHTS_"}) {
    absl::string_view set = name;
    if (!absl::ConsumePrefix(&set, prefix)) continue;
    return !set.empty() && std::all_of(set.begin(), set.end(), absl::ascii_isdigit);
  }
  return false;
}

absl::Status CheckPrimitive(const Json& primitive, const Json&, const std::string& where) {
  const Json& attributes = primitive["attributes"];
  for (const auto& [name, accessor] : attributes.items()) {
    if (IsAttribute(name)) continue;
    return Wrong(where, absl::StrCat("there is no attribute \"", Printable(name), "\""));
  }
  for (const Json& target : primitive.value("targets", Json::array())) {
    for (const auto& [name, accessor] : target.items()) {
      if (attributes.contains(name)) continue;
      return Wrong(where, absl::StrCat("a target moves ", Printable(name), ", which it has not"));
    }
  }
  return absl::OkStatus();
}

absl::Status CheckMesh(const Json& mesh, const Json&, const std::string& where) {
  const Json& primitives = mesh["primitives"];
  const auto targets = [](const Json& primitive) {
    const auto found = primitive.find("targets");
    return found == primitive.end() ? size_t{0} : found->size();
  };
  const size_t count = targets(primitives[0]);
  for (const Json& primitive : primitives) {
    if (targets(primitive) != count) {
      return Wrong(where, "its primitives have different numbers of targets");
    }
  }
  if (mesh.contains("weights") && mesh["weights"].size() != count) {
    return Wrong(
        where, absl::StrCat("it has ", mesh["weights"].size(), " weights for ", count, " targets"));
  }
  return absl::OkStatus();
}

absl::Status CheckAnimation(const Json& animation, const Json&, const std::string& where) {
  const auto samplers = static_cast<double>(animation["samplers"].size());
  for (const Json& channel : animation["channels"]) {
    const double sampler = channel["sampler"].get<double>();
    if (sampler >= samplers) {
      return Wrong(where, absl::StrCat("its sampler ", sampler, " does not exist"));
    }
  }
  return absl::OkStatus();
}

struct Relation {
  const char* object;
  absl::Status (*check)(const Json& value, const Json& root, const std::string& where);
};
constexpr Relation kRelations[] = {
    {"accessor", CheckAccessor},   {"animation", CheckAnimation}, {"buffer view", CheckBufferView},
    {"camera", CheckCamera},       {"light", CheckLight},         {"mesh", CheckMesh},
    {"node", CheckNode},           {"orthographic", CheckLens},   {"perspective", CheckLens},
    {"primitive", CheckPrimitive}, {"spot", CheckSpot},
};

}  // namespace

absl::Status CheckRelations(const std::string& object, const Json& value, const Json& root,
                            const std::string& where) {
  for (const Relation& relation : kRelations) {
    if (object == relation.object) return relation.check(value, root, where);
  }
  return absl::OkStatus();
}

}  // namespace lambert
