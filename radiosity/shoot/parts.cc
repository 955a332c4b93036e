#include "radiosity/shoot/parts.h"

#include <algorithm>

namespace lambert {
namespace {

// By the value of the enumeration.
constexpr const char* kNames[] = {"color",      "pyramids",  "dim-densities", "black",
                                  "clusters",   "alpha",     "hierarchy",     "ambient",
                                  "visibility", "std-error", "unlit"};
constexpr char kNone[] = "none";

}  // namespace

const char* PartName(Part part) { return kNames[static_cast<int>(part)]; }

std::vector<Part> AllParts() {
  std::vector<Part> parts;
  for (size_t k = 0; k < std::size(kNames); ++k) parts.push_back(static_cast<Part>(k));
  return parts;
}

std::string PartSet::Text() const {
  std::string text;
  for (Part part : AllParts()) {
    if (Has(part)) text += (text.empty() ? "" : ",") + std::string(PartName(part));
  }
  return text.empty() ? kNone : text;
}

bool PartSet::Read(const std::string& text) {
  PartSet read;
  for (size_t begin = 0; text != kNone && begin <= text.size();) {
    const size_t end = std::min(text.find_first_of(",+", begin), text.size());
    const auto* found =
        std::find(std::begin(kNames), std::end(kNames), text.substr(begin, end - begin));
    if (found == std::end(kNames)) return false;
    read.Add(static_cast<Part>(found - std::begin(kNames)));
    begin = end + 1;
  }
  *this = read;
  return true;
}

}  // namespace lambert
