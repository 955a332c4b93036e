// Records in PostgreSQL, with a server of the test's own: one owner, and what becomes of it.
#include "server/database/postgres_record_store.h"

#include <gtest/gtest.h>

#include <thread>

#include "radiosity/core/error.h"
#include "tests/support/temporary_postgres.h"

namespace lambert::server {
namespace {

using Records = std::map<std::string, std::string>;

class PostgresRecords : public testing::Test {
 protected:
  void SetUp() override {
    std::string why;
    if (!TemporaryPostgres::IsPossible(why)) GTEST_SKIP() << why;
    postgres_ = std::make_unique<TemporaryPostgres>();
  }
  absl::StatusOr<std::unique_ptr<RecordStore>> TryOpen(std::function<bool()> wait) {
    return OpenPostgresRecordStore({postgres_->url(), std::chrono::seconds(2), std::move(wait)});
  }
  std::unique_ptr<RecordStore> Open() {
    return *TryOpen([] {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      return true;
    });
  }
  std::unique_ptr<TemporaryPostgres> postgres_;
};

TEST_F(PostgresRecords, AreFoundAgain) {
  const std::string bytes("\0\1'\xff\\x", 6);
  ASSERT_TRUE(Open()->Commit({{"jobs", "a", "1"}, {"jobs", "b", "2"}, {"scenes", "a", ""}}).ok());
  ASSERT_TRUE(Open()->Commit({{"jobs", "a", std::nullopt}, {"jobs", "b", bytes}}).ok());
  auto records = Open();
  EXPECT_EQ(records->epoch(), 3);
  EXPECT_EQ(*records->LoadAll("jobs"), (Records{{"b", bytes}}));
  EXPECT_EQ(*records->LoadAll("scenes"), (Records{{"a", ""}}));
  EXPECT_TRUE(absl::IsNotFound(records->Load("jobs", "a").status()));
  EXPECT_EQ(*records->Load("jobs", "b"), bytes);
}

TEST_F(PostgresRecords, HaveOneOwnerUntilItIsSilent) {
  auto first = Open();
  ASSERT_TRUE(first->Commit({{"jobs", "a", "1"}}).ok());
  // A standby gets nothing while the owner shows itself.
  int waits = 0;
  EXPECT_TRUE(absl::IsCancelled(TryOpen([&] {
                                  EXPECT_TRUE(first->CheckOwner().ok());
                                  return ++waits < 10;
                                }).status()));
  // Then the owner falls silent, as if frozen, and the standby takes over.
  auto second = Open();
  EXPECT_EQ(second->epoch(), first->epoch() + 1);
  EXPECT_EQ(ReasonOf(first->CheckOwner()), "FENCED");
  EXPECT_EQ(ReasonOf(first->Commit({{"jobs", "a", "2"}})), "FENCED");
  EXPECT_EQ(*second->Load("jobs", "a"), "1");
  // The end of one that was fenced takes nothing from its successor.
  first.reset();
  EXPECT_TRUE(second->CheckOwner().ok());
}

TEST_F(PostgresRecords, OutlastARestartOfTheDatabase) {
  auto records = Open();
  ASSERT_TRUE(records->Commit({{"jobs", "a", "1"}}).ok());
  postgres_->Restart();
  EXPECT_TRUE(records->Commit({{"jobs", "b", "2"}}).ok());
  EXPECT_EQ(*records->LoadAll("jobs"), (Records{{"a", "1"}, {"b", "2"}}));
}

TEST_F(PostgresRecords, AreLostWithTheDatabase) {
  auto records = Open();
  postgres_->Stop();
  const absl::Status lost = records->CheckOwner();
  EXPECT_EQ(ReasonOf(lost), "DATABASE_LOST");
  EXPECT_TRUE(IsOwnershipLost(lost));
  EXPECT_EQ(ReasonOf(TryOpen([] { return false; }).status()), "STORE_FAILED");
}

}  // namespace
}  // namespace lambert::server
