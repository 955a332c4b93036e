// The patch set of a job: built from its scene, and split where light needs it.
#pragma once

#include <memory>

#include "absl/status/statusor.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/solve/adapt_mesh.h"
#include "server/jobs/job.h"
#include "server/jobs/journal.h"
#include "server/jobs/spec.h"
#include "server/run/runner_parts.h"

namespace lambert::server {

// One thread. All that it is made from outlives it.
class PatchMaker {
 public:
  PatchMaker(const RunnerParts& parts, Job& job, Journal& journal)
      : parts_(parts), job_(job), journal_(journal) {}

  // Makes the patch set and stores it; the job's record then names it. After a restart it is read
  // back; if it was not done, all starts anew, and the pilots' steps come from the journal.
  absl::StatusOr<std::shared_ptr<const PatchSet>> Make(const JobOptions& options);

 private:
  absl::StatusOr<std::shared_ptr<const PatchSet>> ReadBack(const v1::Digest& digest) const;
  absl::StatusOr<std::shared_ptr<const PatchSet>> Adapt(const Scene& scene,
                                                        const JobOptions& options);
  absl::StatusOr<Solution> RunPilot(const std::shared_ptr<const PatchSet>& patches,
                                    const SolveOptions& pilot, Meshing& meshing);
  // Puts the set in the place of the one that the job has, if any.
  absl::Status Store(const PatchSet& patches);

  const RunnerParts& parts_;
  Job& job_;
  Journal& journal_;
};

}  // namespace lambert::server
