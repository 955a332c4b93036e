// Everything that the output files tell of one run.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "radiosity/lightmap/atlas.h"
#include "radiosity/output/compare.h"
#include "radiosity/output/convergence.h"
#include "radiosity/output/exposure.h"
#include "radiosity/output/sensors.h"
#include "radiosity/patch/build_patches.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solve/adapt_mesh.h"
#include "radiosity/solve/plan.h"
#include "radiosity/solve/solution.h"
#include "radiosity/solve/solver.h"

namespace lambert {

struct RunRecord {
  std::string name;          // of the scene, without folder and ending: "room" gives room.glb
  std::string scene_digest;  // SHA-256 of what was submitted
  std::shared_ptr<const PatchSet> patches;
  std::shared_ptr<const Scene>
      scene;  // that they were built of, in metres; null where it is not at hand
  std::shared_ptr<const Atlas> atlas;  // of both; null where no lightmap is wanted
  PatchOptions patch_options;
  PictureOptions picture_options;
  std::optional<Meshing> meshing;  // where it was on
  Plan plan;                       // with the options that were used
  Snapshot snapshot;               // the last one; its solution is not null
  StopReason stop_reason = StopReason::kNone;
  bool interrupted = false;                                   // stopped by hand before any goal
  int workers = 0;                                            // that took part; 0: not known
  int threads = 0;                                            // a worker; 0: not known
  std::vector<ConvergenceRow> convergence;                    // as in convergence.csv, in order
  int final_gather_rays = 0;                                  // a point of pictures; 0: none
  std::optional<ErrorMeasures> measures;                      // of the snapshot, with a reference
  std::vector<SensorGrid> sensors;                            // gathered
  std::vector<std::pair<std::string, std::string>> versions;  // program or library, version
  std::string unit_version;                                   // the pins: UnitVersion()
  std::vector<std::pair<std::string, double>> timings_s;      // what, seconds, in order
};

// What quantities are called: the solution is photometric unless the file's emission was declared
// radiometric.
struct UnitNames {
  const char* flux;        // "lm" or "W"
  const char* irradiance;  // "lx" or "W/m2"
  const char* radiosity;   // "lm/m2" or "W/m2"
};
inline UnitNames UnitNamesOf(EmissionUnit unit) {
  return unit == EmissionUnit::kNit ? UnitNames{"lm", "lx", "lm/m2"}
                                    : UnitNames{"W", "W/m2", "W/m2"};
}

// The patches that no ray has hit, in order: their standard errors are guesses. Empty for method
// exact and where nothing emits: there it is known that they get no light.
std::vector<PatchIndex> NeverHit(const RunRecord& record);

}  // namespace lambert
