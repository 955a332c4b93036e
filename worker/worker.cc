#include "worker/worker.h"

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <cmath>
#include <exception>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "radiosity/shoot/unit.h"
#include "worker/lease_book.h"
#include "worker/out_of_memory.h"
#include "worker/result_sender.h"
#include "worker/server_link.h"
#include "worker/session.h"

namespace lambert::worker {
namespace {

// Two jobs may take turns; more would cost memory for nothing.
constexpr size_t kShooters = 2;

absl::StatusOr<FinishedUnit> RunUnit(ShooterCache& shooters, const v1::Lease& lease) try {
  absl::StatusOr<std::shared_ptr<const Shooter>> shooter =
      shooters.Get({lease.patch_set_digest().sha256(), lease.patch_set_digest().size_bytes(),
                    lease.shoot_options(), lease.gather_task_digest().sha256(),
                    lease.gather_task_digest().size_bytes()});
  if (!shooter.ok()) return shooter.status();
  absl::StatusOr<WorkUnit> unit = DecodeUnit(lease.unit());
  if (!unit.ok()) return unit.status();
  const auto start = std::chrono::steady_clock::now();
  absl::StatusOr<UnitResult> result = (*shooter)->Run(*unit);
  if (!result.ok()) return result.status();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  // Shards could not tell: each sees a part.
  if (lease.merge_ranges_size() > 0) {
    if (absl::Status sound = CheckLedger(*unit, *result); !sound.ok()) return sound;
  }
  return FinishedUnit{lease, *std::move(result), unit->RayCount(), took.count()};
} catch (const std::exception& error) {
  return OutOfMemory(error);
}

}  // namespace

class Worker::Impl {
 public:
  Impl(std::shared_ptr<grpc::Channel> channel, const WorkerOptions& options)
      : options_(options),
        link_(std::move(channel)),
        shooters_(
            [this](const std::string& sha256, int64_t size_bytes) {
              counters_.patch_bytes += size_bytes;
              return link_.Download(sha256, size_bytes);
            },
            options.make_shooter, kShooters),
        sender_(&link_, &book_, options, [this] { session_.Report(); }),
        session_(&link_, &book_, options) {
    for (int i = 0; i < options.slots; ++i) {
      runners_.emplace_back([this] { RunUnits(); });
    }
  }
  ~Impl() {
    book_.Close();
    session_.StartDraining();
    sender_.StopRetrying();
    for (std::thread& runner : runners_) runner.join();
    book_.WaitUntilIdle();
    session_.End();
  }

 private:
  void RunUnits() {
    while (std::optional<v1::Lease> lease = book_.Take()) {
      ++counters_.running;
      absl::StatusOr<FinishedUnit> ran = RunUnit(shooters_, *lease);
      --counters_.running;
      if (ran.ok()) {
        ++counters_.units_done;
        counters_.rays += ran->result.rays;
        counters_.run_microseconds += std::llround(ran->run_seconds * 1e6);
        sender_.Send(*std::move(ran));
      } else {
        ++counters_.units_failed;
        options_.log({"unit failed: " + std::string(ran.status().message()), SubjectOf(*lease)});
        book_.Fail(lease->name(), std::string(ran.status().message()));
        session_.Report();
      }
    }
  }

  const WorkerOptions options_;
  WorkerCounters& counters_ = *options_.counters;
  ServerLink link_;
  LeaseBook book_;
  ShooterCache shooters_;
  ResultSender sender_;
  Session session_;
  std::vector<std::thread> runners_;
};

Worker::Worker(std::shared_ptr<grpc::Channel> channel, const WorkerOptions& options)
    : impl_(std::make_unique<Impl>(std::move(channel), options)) {}
Worker::~Worker() = default;

}  // namespace lambert::worker
