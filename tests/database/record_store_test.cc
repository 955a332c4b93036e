// Record stores that outlast the process: all or nothing, one owner, errors by their names.
#include "server/base/record_store.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>

#include "radiosity/core/error.h"
#include "server/database/open_stores.h"
#include "server/database/sqlite_record_store.h"
#include "tests/support/temporary_folder.h"

namespace lambert::server {
namespace {

using Records = std::map<std::string, std::string>;

class SqliteRecords : public testing::Test {
 protected:
  std::unique_ptr<RecordStore> Open() { return *OpenSqliteRecordStore(path_); }
  TemporaryFolder folder_;
  const std::string path_ = folder_.path() + "/lambert.db";
};

TEST_F(SqliteRecords, AreFoundAgain) {
  ASSERT_TRUE(Open()->Commit({{"jobs", "a", "1"}, {"jobs", "b", "2"}, {"scenes", "a", ""}}).ok());
  ASSERT_TRUE(Open()->Commit({{"jobs", "a", std::nullopt}, {"jobs", "b", "3"}}).ok());
  auto records = Open();
  EXPECT_EQ(*records->LoadAll("jobs"), (Records{{"b", "3"}}));
  EXPECT_EQ(*records->LoadAll("scenes"), (Records{{"a", ""}}));
  EXPECT_TRUE(absl::IsNotFound(records->Load("jobs", "a").status()));
  EXPECT_EQ(*records->Load("jobs", "b"), "3");
  EXPECT_TRUE(records->LoadAll("snapshots")->empty());
}

TEST_F(SqliteRecords, KeepAnyBytes) {
  std::string bytes("\0\1'\xff", 4);
  bytes.resize(3 << 20, 'x');
  ASSERT_TRUE(Open()->Commit({{"jobs", "a", bytes}}).ok());
  EXPECT_EQ(*Open()->Load("jobs", "a"), bytes);
}

TEST_F(SqliteRecords, AreRefusedToAnOwnerOfAnEarlierEpoch) {
  auto first = Open();
  ASSERT_TRUE(first->Commit({{"jobs", "a", "1"}}).ok());
  auto second = Open();
  EXPECT_EQ(second->epoch(), first->epoch() + 1);
  EXPECT_EQ(ReasonOf(first->Commit({{"jobs", "a", "2"}})), "FENCED");
  EXPECT_EQ(ReasonOf(first->CheckOwner()), "FENCED");
  EXPECT_TRUE(IsOwnershipLost(first->CheckOwner()));
  EXPECT_TRUE(second->CheckOwner().ok());
  EXPECT_EQ(*second->Load("jobs", "a"), "1");
  EXPECT_TRUE(second->Commit({{"jobs", "a", "3"}}).ok());
}

// Files may not grow over a limit, as on a full disk.
TEST_F(SqliteRecords, OfAFullDiskLoseNothing) {
  auto records = Open();
  ASSERT_TRUE(records->Commit({{"jobs", "a", "1"}}).ok());
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before;
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit full = {1 << 20, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &full);
  const absl::Status refused =
      records->Commit({{"jobs", "a", "2"}, {"jobs", "b", std::string(2 << 20, 'x')}});
  // Many small ones: the log would pass the limit if it were not folded into the database.
  absl::Status small;
  for (int i = 0; i < 120 && small.ok(); ++i) {
    small = records->Commit({{"jobs", "c", std::string(8000, 'x')}});
  }
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(ReasonOf(refused), "STORE_FULL");
  EXPECT_TRUE(small.ok()) << small;
  records.reset();
  EXPECT_EQ(*Open()->Load("jobs", "a"), "1");
  EXPECT_TRUE(absl::IsNotFound(Open()->Load("jobs", "b").status()));
  EXPECT_TRUE(Open()->Commit({{"jobs", "a", "2"}}).ok());
}

TEST_F(SqliteRecords, OfAnotherKindOfFileAreRefused) {
  std::ofstream(path_) << "This is no database, and it is long enough to be looked at as one.\n";
  EXPECT_EQ(ReasonOf(OpenSqliteRecordStore(path_).status()), "STORE_FAILED");
}

TEST(OpenStores, RefusesASecondServerUntilTheFirstHasEnded) {
  TemporaryFolder folder;
  {
    absl::StatusOr<Stores> first = OpenStores({folder.path(), {}});
    ASSERT_TRUE(first.ok());
    EXPECT_EQ(ReasonOf(OpenStores({folder.path(), {}}).status()), "STORE_IN_USE");
  }
  EXPECT_TRUE(OpenStores({folder.path(), {}}).ok());
}

TEST(OpenStores, RefusesADatabaseThatItCannotUse) {
  TemporaryFolder folder;
  EXPECT_EQ(ReasonOf(OpenStores({folder.path(), "mysql://x"}).status()), "FIELD_INVALID");
  EXPECT_EQ(ReasonOf(OpenStores({"", "postgresql://x"}).status()), "FIELD_INVALID");
}

TEST(NullRecordStore, KeepsNothing) {
  auto records = MakeNullRecordStore();
  EXPECT_FALSE(records->keeps());
  EXPECT_TRUE(records->Commit({{"jobs", "a", "1"}}).ok());
  EXPECT_TRUE(absl::IsNotFound(records->Load("jobs", "a").status()));
  EXPECT_TRUE(records->CheckOwner().ok());
}

}  // namespace
}  // namespace lambert::server
