#include <gtest/gtest.h>

#include <atomic>
#include <new>
#include <thread>

#include "absl/synchronization/notification.h"
#include "radiosity/shoot/options_codec.h"
#include "tests/service/service_fixture.h"
#include "tests/support/stub_shooter.h"
#include "worker/lease_book.h"
#include "worker/shooter_cache.h"

namespace lambert::worker {
namespace {

v1::Lease MakeLease(const std::string& name) {
  v1::Lease lease;
  lease.set_name(name);
  return lease;
}

TEST(LeaseBook, ReportsWhatWaitsAndWhatRuns) {
  LeaseBook book;
  book.Add(MakeLease("a"));
  book.Add(MakeLease("b"));
  EXPECT_EQ(book.Take()->name(), "a");
  const auto reports = book.Reports();
  ASSERT_EQ(reports.size(), 2u);
  EXPECT_EQ(reports[0].lease(), "a");
  EXPECT_EQ(reports[0].state(), v1::LeaseReport::STATE_ACTIVE);
  EXPECT_EQ(reports[1].state(), v1::LeaseReport::STATE_WAITING);
}

TEST(LeaseBook, RevokesOnlyWhatWaits) {
  LeaseBook book;
  book.Add(MakeLease("a"));
  book.Add(MakeLease("b"));
  book.Take();
  book.Revoke("a");
  book.Revoke("b");
  ASSERT_EQ(book.Reports().size(), 1u);
  EXPECT_EQ(book.Reports()[0].lease(), "a");
}

TEST(LeaseBook, AFailureIsReportedUntilTheReportArrived) {
  LeaseBook book;
  book.Add(MakeLease("a"));
  book.Take();
  book.Fail("a", "why");
  const auto reports = book.Reports();
  ASSERT_EQ(reports.size(), 1u);
  EXPECT_EQ(reports[0].state(), v1::LeaseReport::STATE_FAILED);
  EXPECT_EQ(reports[0].error_message(), "why");
  EXPECT_EQ(book.Reports().size(), 1u);
  book.Confirm(reports);
  EXPECT_TRUE(book.Reports().empty());
}

TEST(LeaseBook, AClosedBookDropsWhatWaitsAndTakesNoMore) {
  LeaseBook book;
  book.Add(MakeLease("a"));
  book.Close();
  book.Add(MakeLease("b"));
  EXPECT_FALSE(book.Take().has_value());
  EXPECT_TRUE(book.Reports().empty());
  book.WaitUntilIdle();
}

TEST(LeaseBook, ALeaseThatOutlivesItsSessionIsNotReported) {
  LeaseBook book;
  book.Add(MakeLease("a"));
  book.Take();
  book.Forget();
  EXPECT_TRUE(book.Reports().empty());
  book.Fail("a", "too late to matter");
  EXPECT_TRUE(book.Reports().empty());
  book.Close();
  book.WaitUntilIdle();
}

class ShooterCacheTest : public testing::Test {
 protected:
  absl::StatusOr<std::shared_ptr<const Shooter>> Get(const std::string& bytes) {
    return cache_.Get({Sha256Hex(bytes), static_cast<int64_t>(bytes.size()), options_});
  }
  const std::string bytes_ = EncodePatchSet(PatchesOf(MakeCornell(1)));
  const std::string options_ = EncodeShootOptions({});
  std::atomic<int> fetched_{0}, made_{0};
  std::string sent_ = bytes_;
  ShooterCache cache_{[this](const std::string&, int64_t) -> absl::StatusOr<std::string> {
                        ++fetched_;
                        return sent_;
                      },
                      [this](std::shared_ptr<const PatchSet> patches, const ShootOptions& options) {
                        ++made_;
                        return Shooter::Create(std::move(patches), options);
                      },
                      2};
};

TEST_F(ShooterCacheTest, MakesAShooterOnceForAllThreads) {
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([this] { EXPECT_TRUE(Get(bytes_).ok()); });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(made_, 1);
}

TEST_F(ShooterCacheTest, RefusesOtherBytesThanItAskedForAndTriesAgain) {
  sent_ = bytes_ + "x";
  EXPECT_TRUE(absl::IsDataLoss(Get(bytes_).status()));
  sent_ = bytes_;
  EXPECT_TRUE(Get(bytes_).ok());
  EXPECT_EQ(fetched_, 2);
}

TEST_F(ShooterCacheTest, DensitiesOfAClosedRoomAreToldWhetherItIsLit) {
  ShootOptions options;
  options.method = Method::kPhs;
  sent_ = EncodePatchSet(PatchesOf(MakeFurnace(0.5)));
  const ShooterKey key{Sha256Hex(sent_), static_cast<int64_t>(sent_.size()),
                       EncodeShootOptions(options)};
  EXPECT_TRUE(cache_.Get(key).ok());
}

TEST_F(ShooterCacheTest, RefusesBytesThatAreNoPatchSet) {
  sent_ = "no patches";
  EXPECT_FALSE(Get(sent_).ok());
  EXPECT_EQ(made_, 0);
}

TEST(ShooterCacheWithoutMemory, SaysSoEachTimeAndLeavesNobodyWaiting) {
  ShooterCache cache(
      [](const std::string&, int64_t) -> absl::StatusOr<std::string> { throw std::bad_alloc(); },
      Shooter::Create, 2);
  for (int i = 0; i < 2; ++i) {
    const absl::Status status = cache.Get({"digest", 1, EncodeShootOptions({})}).status();
    EXPECT_TRUE(absl::IsResourceExhausted(status)) << status;
    EXPECT_NE(status.message().find("not enough memory"), absl::string_view::npos);
  }
}

TEST_F(ShooterCacheTest, ForgetsTheLeastRecentlyUsed) {
  auto other = [](int n) { return EncodePatchSet(PatchesOf(MakeCornell(n))); };
  ASSERT_TRUE(Get(bytes_).ok());
  for (int n : {2, 3}) {
    sent_ = other(n);
    ASSERT_TRUE(Get(sent_).ok());
  }
  sent_ = bytes_;
  ASSERT_TRUE(Get(bytes_).ok());
  EXPECT_EQ(made_, 4);
}

// A shooter that fails, or waits, or lies; then shoots as the real one does.
class FakeShooter : public Shooter {
 public:
  FakeShooter(std::shared_ptr<const Shooter> real,
              std::function<absl::Status(UnitResult&)> interfere)
      : real_(std::move(real)), interfere_(std::move(interfere)) {}
  absl::StatusOr<UnitResult> Run(const WorkUnit& unit) const override {
    absl::StatusOr<UnitResult> result = real_->Run(unit);
    if (absl::Status status = interfere_(*result); !status.ok()) return status;
    return result;
  }

 private:
  const std::shared_ptr<const Shooter> real_;
  const std::function<absl::Status(UnitResult&)> interfere_;
};

ShooterFactory Faking(std::function<absl::Status(UnitResult&)> interfere) {
  return
      [interfere](std::shared_ptr<const PatchSet> patches,
                  const ShootOptions& options) -> absl::StatusOr<std::shared_ptr<const Shooter>> {
        auto real = Shooter::Create(std::move(patches), options);
        if (!real.ok()) return real.status();
        return std::make_shared<const FakeShooter>(*real, interfere);
      };
}

using WorkerTest = ServiceFixture;

TEST_F(WorkerTest, AUnitThatFailsEverywhereFailsTheJobWithTheReason) {
  AddWorker(Faking([](UnitResult&) { return absl::InternalError("broken on purpose"); }));
  const Watched watched = Watch(CreateJob().name());
  EXPECT_EQ(watched.ended.state(), lambert::v1::SolveJob::STATE_FAILED);
  google::rpc::ErrorInfo info;
  ASSERT_TRUE(watched.ended.error().details(0).UnpackTo(&info));
  EXPECT_EQ(info.reason(), "UNIT_ATTEMPTS_EXHAUSTED");
  EXPECT_NE(watched.ended.error().message().find("broken on purpose"), std::string::npos);
}

TEST_F(WorkerTest, AUnitThatFailsOnceIsRunAgainAndChangesNothing) {
  AddWorker();
  const std::string expected = Watch(CreateJob(20'000, "sound").name()).payload;
  workers_.clear();
  std::atomic<int> runs{0};
  AddWorker(Faking([&runs](UnitResult&) {
    return ++runs % 5 == 1 ? absl::InternalError("now and then") : absl::OkStatus();
  }));
  const Watched watched = Watch(CreateJob(20'000, "shaky").name());
  EXPECT_EQ(watched.ended.state(), lambert::v1::SolveJob::STATE_SUCCEEDED);
  EXPECT_EQ(watched.payload, expected);
}

TEST_F(WorkerTest, AResultThatLosesFluxIsRefusedUntilTheJobFails) {
  AddWorker(Faking([](UnitResult& result) {
    result.deposits[0].r += 1;
    result.deposits[0].hits += 1;
    return absl::OkStatus();
  }));
  const Watched watched = Watch(CreateJob().name());
  EXPECT_EQ(watched.ended.state(), lambert::v1::SolveJob::STATE_FAILED);
  EXPECT_NE(watched.ended.error().message().find("worker-0"), std::string::npos);
}

// Each of these leaves the work to a sound worker, and no trace in the solution.
TEST_F(WorkerTest, WorkersThatLieOrFailAlwaysChangeNothingBesideASoundOne) {
  AddWorker();
  const std::string expected = Watch(CreateJob(200'000, "sound", 2, "pmcr").name()).payload;
  std::atomic<int> lies{0}, failures{0};
  AddWorker(Faking([&lies](UnitResult& result) {
    ++lies;
    result.escaped[0] += 1;
    return absl::OkStatus();
  }));
  AddWorker(Faking([&failures](UnitResult&) {
    ++failures;
    return absl::ResourceExhaustedError("no memory");
  }));
  for (int i = 0; i < 20 && (lies == 0 || failures == 0); ++i) {
    const Watched watched = Watch(CreateJob(200'000, "", 2, "pmcr").name());
    EXPECT_EQ(watched.ended.state(), lambert::v1::SolveJob::STATE_SUCCEEDED)
        << watched.ended.error().message();
    EXPECT_EQ(watched.payload, expected);
  }
  EXPECT_GT(lies, 0);
  EXPECT_GT(failures, 0);
}

TEST_F(WorkerTest, AWorkerThatLeavesFinishesWhatRunsAndHandsBackTheRest) {
  absl::Notification running, go_on;
  std::atomic<bool> first{true};
  AddWorker(Faking([&](UnitResult&) {
    if (first.exchange(false)) {
      running.Notify();
      go_on.WaitForNotification();
    }
    return absl::OkStatus();
  }));
  const lambert::v1::SolveJob job = CreateJob();
  running.WaitForNotification();
  std::thread leaving([this] { workers_.clear(); });
  go_on.Notify();
  leaving.join();
  for (const server::WorkerInfo& worker : coordinator_->work().ListWorkers()) {
    ADD_FAILURE() << worker.worker_id << " still has a session";
  }
  AddWorker();
  EXPECT_EQ(Watch(job.name()).ended.state(), lambert::v1::SolveJob::STATE_SUCCEEDED);
}

TEST_F(WorkerTest, AnotherUnitVersionIsToldSo) {
  absl::Notification refused;
  WorkerOptions options;
  options.worker_id = "old";
  options.unit_version = "from last year";
  std::string message;
  options.on_refused = [&](const absl::Status& status) {
    message = std::string(status.message());
    refused.Notify();
  };
  Worker worker(rpc_->InProcessChannel(), options);
  refused.WaitForNotification();
  EXPECT_NE(message.find("from last year"), std::string::npos);
}

// Units that end while a result is on its way travel together.
TEST_F(WorkerTest, ManySlotsSendFewerResultsThanUnitsAndTheSameBytes) {
  AddWorker(MakeStubShooter);
  const std::string expected = Watch(CreateJob(1'000'000, "one", 2, "pmcr").name()).payload;
  workers_.clear();
  AddWorker(MakeStubShooter, 16);
  const server::WorkCounters& counters = coordinator_->work().counters();
  const int64_t before = counters.results_accepted;
  int64_t units = 0;
  for (int i = 0; i < 50 && units == counters.results_accepted - before; ++i) {
    EXPECT_EQ(Watch(CreateJob(1'000'000, "", 2, "pmcr").name()).payload, expected);
    units = coordinator_->work().ListWorkers().at(0).finished_units;
  }
  EXPECT_GT(units, counters.results_accepted - before);
}

TEST_F(WorkerTest, SeveralSlotsGiveTheBytesOfOne) {
  AddWorker();
  const std::string expected = Watch(CreateJob(50'000, "one").name()).payload;
  workers_.clear();
  AddWorker(Shooter::Create, 4);
  EXPECT_EQ(Watch(CreateJob(50'000, "four").name()).payload, expected);
}

}  // namespace
}  // namespace lambert::worker
