// The parts of the work that a scene may not need (radiosity/solve/plan.h decides), and which of
// them are done or left out.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lambert {

enum class Part : uint8_t {
  kColor,         // three channels: left out, one is shot for all of a gray scene
  kPyramids,      // densities: left out, every ray goes by the cosine law
  kDimDensities,  // densities also where too few rays follow them to pay for them
  kBlack,         // patches that reflect nothing count in densities
  kClusters,      // patches are counted by clusters: left out, vertex by vertex, to the same counts
  kAlpha,         // phs-alpha counts what was hit: left out, it is phs
  kHierarchy,     // phs-hier's elements: left out, it is phs
  kAmbient,       // flux is shot before it has arrived (radiosity/solve/ambient.h)
  kVisibility,    // exact: what stands between two patches
  kStdError,      // replicates: left out, the budget is one pass and the error is not known
  kUnlit,         // walls of rooms that no light reaches count in densities
};

// "color", "pyramids", ...
const char* PartName(Part part);
std::vector<Part> AllParts();

// Any number of parts.
class PartSet {
 public:
  bool Has(Part part) const { return (bits_ >> static_cast<int>(part) & 1) != 0; }
  void Add(Part part) { bits_ |= 1u << static_cast<int>(part); }
  PartSet operator&(PartSet other) const { return PartSet(bits_ & other.bits_); }
  bool operator==(const PartSet&) const = default;

  PartSet() = default;
  // In the order of AllParts, by commas; "none" for no part.
  std::string Text() const;
  // Reads names by commas or plus signs, or "none", in place of what it held. False, and nothing
  // changes, where one is no part.
  bool Read(const std::string& text);

 private:
  explicit PartSet(uint32_t bits) : bits_(bits) {}
  uint32_t bits_ = 0;
};

// What is asked for, or what a plan decided. A part in neither set is the planner's choice; code
// that runs without a plan does what such a part's scene would need.
struct Parts {
  PartSet with, without;
  bool operator==(const Parts&) const = default;
};

}  // namespace lambert
