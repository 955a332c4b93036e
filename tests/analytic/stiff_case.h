// A stiff scene solved over seeds, and what is held against closed forms.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <vector>

#include "radiosity/scene/scene.h"
#include "tests/analytic/seeds.h"

namespace lambert {

inline constexpr int kStiffSeeds = 8;
inline constexpr int64_t kStiffRays = 50000;

// A scene, and its solutions over eight seeds by a method.
struct StiffCase {
  nlohmann::json stated;  // by the manifest
  Scene scene;
  PatchSet patches;
  SolveOptions options;
  std::vector<Solution> solutions;
};

using Value = std::function<double(const Solution&)>;

// Within four standard errors over eight seeds or else, as hundreds of values do not all come out
// by chance, over 64 others. `least`: what the mean can be off by whatever the seeds, absolute.
void ExpectValue(const StiffCase& c, const Value& value, double truth, double least);

// sum A B of a channel. What the manifest allows is for areas that float32 rounds; relative.
void ExpectPower(const StiffCase& c, int channel, double truth, double allowed = 0);

// Every patch that rays have hit often enough is as bright as the closed form says, by its own
// standard errors; so is the power.
void ExpectUniform(const StiffCase& c, int channel, double ratio);

// Mean radiosity of some patches, red channel, in the unit `exitance`. Where the truth is 0, every
// solution has 0: no chance makes light where none comes to.
void ExpectRadiosity(const StiffCase& c, const std::vector<PatchIndex>& of, double exitance,
                     double truth);

}  // namespace lambert
