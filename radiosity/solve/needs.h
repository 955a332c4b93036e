// What a scene needs of the work, part by part.
#pragma once

#include <string>
#include <vector>

#include "radiosity/patch/patch_set.h"
#include "radiosity/solve/options.h"

namespace lambert {

struct Need {
  Part part;
  std::string item;  // in words: "three channels"
  bool needed = true;
  std::string reason{};    // why so: one sentence
  std::string saving{};    // of leaving it out, in words with a number; "" for nothing measured
  std::string only_way{};  // why it cannot be otherwise; "" where it can be forced
};

// Whether a part of the scene, such as one room of it, may reflect nearly all, so that light goes
// on for a hundred bounces and more.
bool IsStiff(const PatchSet& patches);

// The parts that there are for options.shoot.method in this scene, whatever `options` say of them.
// Requires: the method is not kAuto.
std::vector<Need> FindNeeds(const PatchSet& patches, const SolveOptions& options);

}  // namespace lambert
