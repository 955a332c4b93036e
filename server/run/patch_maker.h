// The patch set of a job: built from its scene, and split where light needs it.
#pragma once

#include <memory>
#include <optional>

#include "absl/status/statusor.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/solve/adapt_mesh.h"
#include "radiosity/solve/solution.h"
#include "server/jobs/job.h"
#include "server/jobs/journal.h"
#include "server/jobs/spec.h"
#include "server/run/runner_parts.h"

namespace lambert::server {

// A solution on patches that are not split to the end.
struct PilotResult {
  std::shared_ptr<const PatchSet> patches;
  Plan plan;
  lambert::Snapshot snapshot;
};

// One thread. All that it is made from outlives it.
class PatchMaker {
 public:
  PatchMaker(const RunnerParts& parts, Job& job, Journal& journal)
      : parts_(parts), job_(job), journal_(journal) {}

  // Makes the patch set and stores it; the job's record then names it. After a restart it is read
  // back; if it was not done, all starts anew, and the pilots' steps come from the journal.
  absl::StatusOr<std::shared_ptr<const PatchSet>> Make(const JobOptions& options);
  // Where Make has failed: the solution of the last pilot that shot anything, if any, whose patch
  // set is then the job's. The record has no `meshing`: a job that goes on makes its patches anew.
  absl::StatusOr<std::optional<PilotResult>> TakeBest();

 private:
  absl::StatusOr<std::shared_ptr<const PatchSet>> ReadBack(const v1::Digest& digest) const;
  absl::StatusOr<std::shared_ptr<const PatchSet>> Adapt(const Scene& scene,
                                                        const JobOptions& options);
  absl::StatusOr<Solution> RunPilot(const std::shared_ptr<const PatchSet>& patches,
                                    const SolveOptions& pilot);
  // Puts the set in the place of the one that the job has, if any. Does nothing where it is that
  // one: the last pilot's often is the job's.
  absl::Status Store(const std::shared_ptr<const PatchSet>& patches);

  const RunnerParts& parts_;
  Job& job_;
  Journal& journal_;
  Meshing meshing_;
  std::optional<PilotResult> best_;
  std::weak_ptr<const PatchSet> stored_;  // the last one
};

}  // namespace lambert::server
