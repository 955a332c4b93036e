// Which method suits a scene, where the user leaves it open.
#pragma once

#include <string>

#include "radiosity/patch/patch_set.h"
#include "radiosity/solve/options.h"

namespace lambert {

struct MethodChoice {
  Method method;       // never kAuto
  std::string reason;  // in words with a number
};

// A function of the scene and the options alone; does not look at options.shoot.method. `adapted`:
// patches are split where light varies inside them (adapt_mesh.h), so what is wanted is the light
// of the scene itself, not of patches that send it evenly.
MethodChoice ChooseMethod(const PatchSet& patches, const SolveOptions& options,
                          bool adapted = false);

}  // namespace lambert
