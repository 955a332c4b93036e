// The result of a job: collected from the service, written to a folder, summed up.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "app/exit.h"
#include "client/client.h"
#include "client/job.h"
#include "radiosity/output/run_record.h"

namespace lambert::app {

// Makes the folder and tries a file in it, so that a folder that cannot be written is told before
// any work is done: OUTPUT_FAILED.
absl::Status TestOutputFolder(const std::string& folder);

// Everything that the job's latest snapshot tells; `patches` may be null and is then fetched. What
// only the caller knows (convergence, measures, workers, timings) is left empty. Requires: the job
// has a snapshot.
absl::StatusOr<RunRecord> CollectRecord(client::Client& client, const client::Job& job,
                                        std::shared_ptr<const PatchSet> patches);

// What an ended job means for the command that waited for it: an error for a failed one,
// kInterrupted for a cancelled one, kBudgetSpent where a wanted error was not reached.
absl::StatusOr<ExitCode> ExitCodeOf(const client::Job& job);

ConvergenceRow MakeConvergenceRow(const Plan& plan, const Progress& progress);

// What a run ended with, on standard output: a few lines, or one JSON object with `json`.
// `folder`: where its files are.
void PrintSummary(const client::Job& job, const RunRecord& record, const std::string& folder,
                  bool json);

}  // namespace lambert::app
