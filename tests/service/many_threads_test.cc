// A work table asked by many threads at once; scripts/sanitize.sh looks for races in it.
#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "absl/synchronization/notification.h"
#include "tests/service/work_fakes.h"

namespace lambert::server {
namespace {

constexpr int kWorkers = 6, kJobs = 2, kSteps = 10, kUnits = 40;

// As a worker: asks and submits until the table shuts down.
void Work(WorkTable& table, const std::string& worker_id) {
  const std::string session = *table.OpenSession(worker_id, 2, "v1");
  for (int64_t sequence = 1;; ++sequence) {
    absl::Notification answered;
    absl::StatusOr<SyncReply> reply;
    table.Sync({session, sequence, {}, false}, &reply, [&](absl::StatusOr<SyncReply> answer) {
      reply = std::move(answer);
      answered.Notify();
    });
    answered.WaitForNotification();
    if (!reply.ok()) return;
    for (const GrantedLease& lease : reply->leases) {
      EXPECT_TRUE(table.Submit(MakeSubmission(lease, MakeResult())).ok());
    }
  }
}

// As a job: publishes steps, one after the other.
void Solve(WorkTable& table, const std::string& job) {
  for (int step = 0; step < kSteps; ++step) {
    const auto published = table.Publish(MakeSetup(job), MakeUnits(kUnits));
    ASSERT_TRUE(published.ok());
    const absl::StatusOr<UnitResult> sum = (*published)->Wait();
    ASSERT_TRUE(sum.ok()) << sum.status();
    EXPECT_EQ(sum->rays, kUnits * kFakeRays);
    EXPECT_EQ(sum->shot, (Quanta{7 * kUnits, 7 * kUnits, 7 * kUnits}));
    table.Withdraw(job);
  }
  table.ForgetJob(job);
}

TEST(WorkTableOfManyThreads, AddsUpEachUnitOnce) {
  WorkOptions options;
  options.sync_interval = std::chrono::milliseconds(5);
  options.max_unit_rays = kFakeRays;  // fake results are those of one grain
  WorkTable table(options, "v1", 1000, SteadyNow);
  std::vector<std::thread> workers, jobs;
  for (int i = 0; i < kWorkers; ++i) {
    workers.emplace_back([&, i] { Work(table, "w" + std::to_string(i)); });
  }
  for (int i = 0; i < kJobs; ++i) {
    jobs.emplace_back([&, i] { Solve(table, "job" + std::to_string(i)); });
  }
  std::atomic<bool> is_over{false};
  std::thread watcher([&] {
    while (!is_over) {
      table.Tick();
      EXPECT_LE(table.Load().workers, kWorkers);
      EXPECT_LE(table.ListWorkers().size(), static_cast<size_t>(kWorkers));
    }
  });
  for (std::thread& job : jobs) job.join();
  is_over = true;
  watcher.join();
  table.Shutdown();
  for (std::thread& worker : workers) worker.join();
  EXPECT_GE(table.counters().results_accepted, kJobs * kSteps * kUnits);
}

}  // namespace
}  // namespace lambert::server
