#include "tests/output/known_light.h"

#include <fstream>
#include <memory>
#include <sstream>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace lambert {

Solution LitBy(const PatchSet& patches, const std::function<Rgb(Vec3)>& irradiance_lx) {
  Solution solution;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const Rgb irradiance = irradiance_lx(patches.origin + PatchCentroid(patches, i));
    const Rgb radiosity = patches.exitance_lm_per_m2[i] + patches.reflectance[i] * irradiance;
    solution.irradiance_lx.push_back(irradiance);
    solution.radiosity_lm_per_m2.push_back(radiosity);
    solution.std_error_lm_per_m2.push_back(radiosity * 0.01);
    solution.hits.push_back(100);
  }
  solution.ledger.emitted = EmittedFlux(patches);
  solution.ledger.absorbed = solution.ledger.emitted;
  return solution;
}

RunRecord RecordOf(const PatchSet& patches, const std::function<Rgb(Vec3)>& irradiance_lx) {
  RunRecord record;
  record.name = "room";
  record.scene_digest = std::string(64, 'a');
  record.patches = std::make_shared<const PatchSet>(patches);
  record.plan = MakePlan(patches, {});
  record.snapshot.solution = std::make_shared<const Solution>(LitBy(patches, irradiance_lx));
  record.snapshot.progress.pass = 2;
  record.snapshot.progress.rays = 123456;
  record.snapshot.progress.seconds = 1.5;
  record.snapshot.progress.estimated_rms_area = 0.02;
  record.stop_reason = StopReason::kErrorReached;
  record.unit_version = "pins-1";
  record.versions = {{"lambert", "0.1.0"}};
  record.timings_s = {{"solve", 1.5}};
  return record;
}

std::string TestFolder() {
  static std::vector<std::unique_ptr<TemporaryFolder>> folders;  // removed when the program ends
  return folders.emplace_back(std::make_unique<TemporaryFolder>())->path();
}

}  // namespace lambert
