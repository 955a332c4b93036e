// Jobs one after the other on one service, each followed to its end and then taken away.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/service.h"
#include "client/client.h"
#include "client/job.h"

namespace lambert::app {

struct FinishedJob {
  client::Job job;  // as it ended
  std::shared_ptr<const Solution> solution;
  double setup_s = 0;                     // from asking for it to its first rays, seconds
  std::optional<int64_t> peak_rss_bytes;  // of this process, where the service is in it
};

// One thread. Its parts outlive it.
class JobRunner {
 public:
  JobRunner(Service& service, Interrupt& interrupt, ProgressPrinter& printer)
      : service_(service), interrupt_(interrupt), printer_(printer) {}

  // Every snapshot of the job comes to `on_snapshot` with its solution, the last one too; an error
  // of it ends the run. CANCELLED (reason INTERRUPTED) after Ctrl-C, and the error of a job that
  // failed.
  absl::StatusOr<FinishedJob> Run(const std::string& scene, const PatchOptions& patch,
                                  const SolveOptions& solve,
                                  const std::function<absl::Status(const Snapshot&)>& on_snapshot);

 private:
  absl::StatusOr<FinishedJob> Follow(
      const client::Job& job, double asked_at_s,
      const std::function<absl::Status(const Snapshot&)>& on_snapshot);
  // The last snapshot may come with the job's end instead of with the stream.
  absl::Status TakeLast(const client::Job& job, FinishedJob& finished,
                        const std::function<absl::Status(const Snapshot&)>& on_snapshot);

  Service& service_;
  Interrupt& interrupt_;
  ProgressPrinter& printer_;
  int64_t seen_version_ = 0;
};

}  // namespace lambert::app
