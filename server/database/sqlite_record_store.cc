#include "server/database/sqlite_record_store.h"

#include <sqlite3.h>

#include <cerrno>
#include <functional>
#include <utility>

#include "absl/synchronization/mutex.h"
#include "radiosity/core/error.h"
#include "server/base/failpoint.h"
#include "server/base/files.h"

namespace lambert::server {
namespace {

constexpr int kSchema = 1;          // PRAGMA user_version
constexpr int kBusyMillis = 10000;  // somebody else looks into the database

constexpr char kSetUp[] = R"sql(
  PRAGMA journal_mode = WAL;
  PRAGMA synchronous = FULL;
)sql";
constexpr char kCreate[] = R"sql(
  CREATE TABLE IF NOT EXISTS records (
    kind TEXT NOT NULL, id TEXT NOT NULL, bytes BLOB NOT NULL,
    PRIMARY KEY (kind, id)) WITHOUT ROWID;
  CREATE TABLE IF NOT EXISTS epochs (number INTEGER NOT NULL);
  INSERT INTO epochs SELECT 0 WHERE NOT EXISTS (SELECT * FROM epochs);
  PRAGMA user_version = 1;
)sql";

// A database connection; ends every use of SQLite's C interface here.
class Connection {
 public:
  explicit Connection(std::string path) : path_(std::move(path)) {}
  ~Connection() { sqlite3_close_v2(database_); }
  Connection(const Connection&) = delete;

  absl::Status Open() {
    const int opened = sqlite3_open_v2(path_.c_str(), &database_,
                                       SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
    if (opened != SQLITE_OK) return Error(opened);
    sqlite3_extended_result_codes(database_, 1);
    sqlite3_busy_timeout(database_, kBusyMillis);
    return Run(kSetUp);
  }

  absl::Status Run(const char* statements) {
    errno = 0;
    const int result = sqlite3_exec(database_, statements, nullptr, nullptr, nullptr);
    return result == SQLITE_OK ? absl::OkStatus() : Error(result);
  }

  using Row = std::function<void(sqlite3_stmt*)>;
  // Runs one statement with text and, last, bytes for its parameters; calls `row` for each row.
  absl::Status Query(const char* statement, const std::vector<std::string>& texts = {},
                     const std::string* bytes = nullptr, const Row& row = nullptr) {
    errno = 0;
    sqlite3_stmt* prepared = nullptr;
    int result = sqlite3_prepare_v2(database_, statement, -1, &prepared, nullptr);
    int parameter = 0;
    for (const std::string& text : texts) {
      sqlite3_bind_text(prepared, ++parameter, text.data(), static_cast<int>(text.size()),
                        SQLITE_STATIC);
    }
    if (bytes != nullptr && result == SQLITE_OK) {
      result =
          sqlite3_bind_blob64(prepared, ++parameter, bytes->data(), bytes->size(), SQLITE_STATIC);
    }
    if (result == SQLITE_OK) {
      while ((result = sqlite3_step(prepared)) == SQLITE_ROW) {
        if (row) row(prepared);
      }
    }
    const absl::Status status = result == SQLITE_DONE ? absl::OkStatus() : Error(result);
    sqlite3_finalize(prepared);
    return status;
  }

  absl::StatusOr<int64_t> Number(const char* statement) {
    int64_t number = 0;
    absl::Status status = Query(statement, {}, nullptr,
                                [&](sqlite3_stmt* row) { number = sqlite3_column_int64(row, 0); });
    if (!status.ok()) return status;
    return number;
  }

 private:
  absl::Status Error(int result) const {
    // SQLite knows of ENOSPC only. What else a write failed with it leaves in errno.
    const int system = errno;
    if (result == SQLITE_FULL) return FileError(path_, ENOSPC);
    if ((result & 0xff) == SQLITE_IOERR && (system == EFBIG || system == EDQUOT)) {
      return FileError(path_, system);
    }
    return MakeError(absl::StatusCode::kInternal,
                     {"STORE_FAILED", path_,
                      database_ == nullptr ? sqlite3_errstr(result) : sqlite3_errmsg(database_),
                      "check the server's data folder"});
  }

  const std::string path_;
  sqlite3* database_ = nullptr;
};

std::string Column(sqlite3_stmt* row, int column) {
  const void* data = sqlite3_column_blob(row, column);
  return {static_cast<const char*>(data), static_cast<size_t>(sqlite3_column_bytes(row, column))};
}

class SqliteRecordStore : public RecordStore {
 public:
  SqliteRecordStore(const std::string& path, std::unique_ptr<FolderLock> lock)
      : path_(path), lock_(std::move(lock)), connection_(path) {}

  absl::Status Open() {
    absl::MutexLock lock(&mutex_);
    if (absl::Status opened = connection_.Open(); !opened.ok()) return opened;
    absl::StatusOr<int64_t> schema = connection_.Number("PRAGMA user_version");
    if (!schema.ok()) return schema.status();
    if (*schema > kSchema) {
      return MakeError(absl::StatusCode::kInternal,
                       {"STORE_FAILED", path_,
                        "was written by a later version (schema " + std::to_string(*schema) + ")",
                        "run that version"});
    }
    return Transaction([this]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
      if (absl::Status made = connection_.Run(kCreate); !made.ok()) return made;
      if (absl::Status taken = connection_.Run("UPDATE epochs SET number = number + 1");
          !taken.ok()) {
        return taken;
      }
      absl::StatusOr<int64_t> epoch = connection_.Number("SELECT number FROM epochs");
      if (epoch.ok()) epoch_ = *epoch;
      return epoch.status();
    });
  }

  absl::Status Commit(const std::vector<RecordChange>& changes) override {
    const auto write = [&]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) { return Write(changes); };
    absl::MutexLock lock(&mutex_);
    absl::Status status = Transaction(write);
    if (absl::IsResourceExhausted(status) &&
        connection_.Run("PRAGMA wal_checkpoint(TRUNCATE)").ok()) {
      status = Transaction(write);
    }
    return status;
  }

  absl::StatusOr<std::string> Load(const std::string& kind, const std::string& id) override {
    absl::MutexLock lock(&mutex_);
    std::optional<std::string> bytes;
    absl::Status status =
        connection_.Query("SELECT bytes FROM records WHERE kind = ? AND id = ?", {kind, id},
                          nullptr, [&](sqlite3_stmt* row) { bytes = Column(row, 0); });
    if (!status.ok()) return status;
    if (!bytes.has_value()) return absl::NotFoundError(kind + "/" + id);
    return *std::move(bytes);
  }

  absl::StatusOr<std::map<std::string, std::string>> LoadAll(const std::string& kind) override {
    absl::MutexLock lock(&mutex_);
    std::map<std::string, std::string> records;
    absl::Status status =
        connection_.Query("SELECT id, bytes FROM records WHERE kind = ?", {kind}, nullptr,
                          [&](sqlite3_stmt* row) { records[Column(row, 0)] = Column(row, 1); });
    if (!status.ok()) return status;
    return records;
  }

  absl::Status CheckOwner() override {
    absl::MutexLock lock(&mutex_);
    return CheckEpoch();
  }

  int64_t epoch() const override { return epoch_; }
  bool keeps() const override { return true; }

 private:
  absl::Status CheckEpoch() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    absl::StatusOr<int64_t> epoch = connection_.Number("SELECT number FROM epochs");
    if (!epoch.ok()) return epoch.status();
    return *epoch == epoch_ ? absl::OkStatus() : FencedError(path_, epoch_, *epoch);
  }

  absl::Status Write(const std::vector<RecordChange>& changes)
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    if (absl::Status owned = CheckEpoch(); !owned.ok()) return owned;
    for (const RecordChange& change : changes) {
      absl::Status changed =
          change.bytes.has_value()
              ? connection_.Query("INSERT OR REPLACE INTO records VALUES (?, ?, ?)",
                                  {change.kind, change.id}, &*change.bytes)
              : connection_.Query("DELETE FROM records WHERE kind = ? AND id = ?",
                                  {change.kind, change.id});
      if (!changed.ok()) return changed;
    }
    return absl::OkStatus();
  }

  absl::Status Transaction(const std::function<absl::Status()>& body)
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    absl::Status status = connection_.Run("BEGIN IMMEDIATE");
    if (!status.ok()) return status;
    status = body();
    Failpoint("record-before-commit");
    if (status.ok()) status = connection_.Run("COMMIT");
    Failpoint("record-after-commit");
    // Of some errors SQLite has rolled back by itself; then this finds nothing to do.
    if (!status.ok()) connection_.Run("ROLLBACK").IgnoreError();
    return status;
  }

  const std::string path_;
  const std::unique_ptr<FolderLock> lock_;  // may be null
  absl::Mutex mutex_;
  Connection connection_ ABSL_GUARDED_BY(mutex_);
  int64_t epoch_ = 0;  // set once, by Open
};

}  // namespace

absl::StatusOr<std::unique_ptr<RecordStore>> OpenSqliteRecordStore(
    const std::string& path, std::unique_ptr<FolderLock> lock) {
  auto store = std::make_unique<SqliteRecordStore>(path, std::move(lock));
  if (absl::Status opened = store->Open(); !opened.ok()) return opened;
  return store;
}

}  // namespace lambert::server
