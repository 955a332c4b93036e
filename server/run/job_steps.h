// The steps of one solver of a job: shot by whoever works for this coordinator, or found in the
// journal, and charged to the job's owner.
#pragma once

#include <string>

#include "radiosity/shoot/options.h"
#include "radiosity/solve/solver.h"
#include "server/jobs/job.h"
#include "server/jobs/journal.h"
#include "server/run/journal_executor.h"
#include "server/run/runner_parts.h"
#include "server/run/table_executor.h"

namespace lambert::server {

// One thread. All that it is made from outlives it.
class JobSteps {
 public:
  // `patches`: how many the job's patch set has. `start`: what is charged already. Requires: the
  // job's patch set is stored.
  JobSteps(const RunnerParts& parts, Job& job, Journal& journal, PatchIndex patches,
           const ShootOptions& shoot, const Progress& start);

  StepExecutor& executor() { return executor_; }
  // Tells watchers, and charges what was shot since the step before. Where the owner has spent what
  // quotas allow, the next step fails.
  void OnStep(const Progress& progress);
  // Says in the log what the journal took.
  void LogSummary() const;

 private:
  const RunnerParts& parts_;
  Job& job_;
  TableExecutor table_;
  JournalExecutor executor_;
  Progress charged_;
};

}  // namespace lambert::server
