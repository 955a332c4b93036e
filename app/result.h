// The result of a job: collected from the service, written to a folder, summed up.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "app/exit.h"
#include "app/options.h"
#include "client/client.h"
#include "client/job.h"
#include "radiosity/output/run_record.h"
#include "radiosity/output/sensors.h"

namespace lambert::app {

// Makes the folder and tries a file in it, so that a folder that cannot be written is told before
// any work is done: OUTPUT_FAILED.
absl::Status TestOutputFolder(const std::string& folder);

// Everything that the job's latest snapshot tells; `patches` may be null and is then fetched. What
// only the caller knows (convergence, measures, workers, timings) is left empty. Requires: the job
// has a snapshot.
absl::StatusOr<RunRecord> CollectRecord(client::Client& client, const client::Job& job,
                                        std::shared_ptr<const PatchSet> patches);

// The sensors of the options' file, none without one: ReadSensors.
absl::StatusOr<std::vector<SensorGrid>> ReadOptionalSensors(const Options& options);

// Writes the files that the options ask for. What has to be gathered for them is, on the service,
// from the job's newest snapshot: at `sensors` and on the work planes of the options, and where
// light is drawn. `say` is told of the progress, a line a second at most. SENSORS_INVALID, and what
// a gather and WriteOutputs fail with.
absl::Status GatherAndWrite(client::Client& client, const client::Job& job, const Options& options,
                            std::vector<SensorGrid> sensors,
                            const std::function<void(const std::string&)>& say, RunRecord& record);

// What an ended job means for the command that waited for it: an error for a failed one,
// kInterrupted for a cancelled one, kBudgetSpent where a wanted error was not reached.
absl::StatusOr<ExitCode> ExitCodeOf(const client::Job& job);

ConvergenceRow MakeConvergenceRow(const Plan& plan, const Progress& progress);

// What a run ended with, on standard output: a few lines, or one JSON object with `json`.
// `folder`: where its files are.
void PrintSummary(const client::Job& job, const RunRecord& record, const std::string& folder,
                  bool json);

}  // namespace lambert::app
