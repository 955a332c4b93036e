// What glTF 2.0 says of each property of its JSON, as a table. Nothing of the JSON is looked at
// here.
#pragma once

#include <limits>
#include <span>

namespace lambert {

enum class GltfKind {
  kInteger,    // a whole number, also one written as 1.0
  kNumber,     // finite
  kNumbers,    // an array of `count` numbers; of any number of them, at least one, where that is 0
  kText,       // a string
  kTexts,      // an array of strings, at least one
  kBool,       // true or false
  kIndex,      // of a `target` in the list of the file that holds them
  kIndices,    // an array of those, at least one, each once
  kIndexMap,   // an object of which every value is such an index
  kIndexMaps,  // an array of those objects, at least one
  kObject,     // a `target`
  kObjects,    // an array of `target`s, at least one
};

// A property of a kind of object. Objects have names of their own: "glTF" is the file, "buffer
// view" an entry of its bufferViews.
struct GltfRule {
  const char* object = "";
  const char* property = "";
  GltfKind kind = GltfKind::kObject;
  const char* target = "";
  double least = -std::numeric_limits<double>::infinity();  // of each number
  double most = std::numeric_limits<double>::infinity();
  int count = 0;
  bool required = false;
};

// An extension, the objects that may have it, and the kind of object that it is there.
struct GltfPlace {
  const char* extension = "";
  const char* object = "";
  const char* content = "";  // "": what is in it is not looked at
};

// glTF 2.0, 5 (properties reference), and the specifications of the extensions.
std::span<const GltfRule> GltfRules();
// Of the extensions that stand nowhere here it is not known where they may stand.
std::span<const GltfPlace> GltfPlaces();

}  // namespace lambert
