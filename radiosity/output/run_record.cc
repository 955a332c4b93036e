#include "radiosity/output/run_record.h"

namespace lambert {

std::vector<PatchIndex> NeverHit(const RunRecord& record) {
  std::vector<PatchIndex> unhit;
  const bool known = record.plan.options.shoot.method == Method::kExact ||
                     record.stop_reason == StopReason::kNothingToShoot;
  if (known) return unhit;
  const std::vector<int64_t>& hits = record.snapshot.solution->hits;
  for (size_t i = 0; i < hits.size(); ++i) {
    if (hits[i] == 0) unhit.push_back(static_cast<PatchIndex>(i));
  }
  return unhit;
}

}  // namespace lambert
