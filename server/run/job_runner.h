// Solves one job: scene, patches, plan, passes, snapshots.
#pragma once

#include <memory>
#include <utility>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/solve/solver.h"
#include "server/jobs/job.h"
#include "server/jobs/journal.h"
#include "server/jobs/spec.h"
#include "server/run/job_steps.h"
#include "server/run/runner_parts.h"

namespace lambert::server {

// Thread safe: runs any number of jobs at once, one a thread.
class JobRunner {
 public:
  explicit JobRunner(RunnerParts parts) : parts_(std::move(parts)) {}

  // Blocks until the job has ended, or the server is shutting down: the job then stays as it is, to
  // be gone on with from its last step. Never throws.
  void Run(Job& job);

 private:
  absl::Status Solve(Job& job, Journal& journal);
  // Where it fails, the best that there was by then is published.
  absl::StatusOr<std::shared_ptr<const PatchSet>> MakePatches(Job& job, Journal& journal,
                                                              const JobOptions& options);
  absl::Status RunPasses(Job& job, Journal& journal, Solver& solver, JobSteps& steps);
  // Stores the solution, and with it what a restart needs, in one transaction; then watchers have
  // it. `solver`: null where there is nothing to restart.
  absl::Status Publish(Job& job, Journal& journal, const Solver* solver,
                       const lambert::Snapshot& made);
  absl::Status Publish(Job& job, Journal& journal, const Solver& solver) {
    return Publish(job, journal, &solver, solver.MakeSnapshot());
  }
  void Finish(Job& job, Journal& journal, const absl::Status& status);

  const RunnerParts parts_;
};

}  // namespace lambert::server
