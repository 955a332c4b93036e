#include "server/database/postgres_record_store.h"

#include <chrono>
#include <pqxx/pqxx>
#include <thread>
#include <utility>

#include "absl/synchronization/mutex.h"
#include "radiosity/core/error.h"

namespace lambert::server {
namespace {

constexpr auto kReconnectPause = std::chrono::milliseconds(100);
constexpr char kDiskFull[] = "53100";  // SQLSTATE

// Serialized: two servers may make the tables at the same time.
constexpr char kCreate[] = R"sql(
  SELECT pg_advisory_xact_lock(7809647, 1);
  CREATE TABLE IF NOT EXISTS lambert_records (
    kind text NOT NULL, id text NOT NULL, bytes bytea NOT NULL, PRIMARY KEY (kind, id));
  CREATE TABLE IF NOT EXISTS lambert_owner (
    one boolean PRIMARY KEY DEFAULT true CHECK (one), epoch bigint NOT NULL,
    seen timestamptz NOT NULL);
  INSERT INTO lambert_owner (epoch, seen) VALUES (0, '-infinity') ON CONFLICT DO NOTHING;
)sql";

class PostgresRecordStore : public RecordStore {
 public:
  explicit PostgresRecordStore(PostgresOptions options) : options_(std::move(options)) {}
  ~PostgresRecordStore() override {
    absl::MutexLock lock(&mutex_);
    if (connection_ == nullptr || epoch_ == 0) return;
    try {
      pqxx::work work(*connection_);
      work.exec_params("UPDATE lambert_owner SET seen = '-infinity' WHERE epoch = $1", epoch_);
      work.commit();
    } catch (const std::exception&) {  // then the next one waits a little
    }
  }

  absl::Status Open() {
    absl::MutexLock lock(&mutex_);
    try {
      connection_ = std::make_unique<pqxx::connection>(options_.url);
    } catch (const std::exception& error) {
      return Failed(error.what());
    }
    absl::Status created = Transaction([](pqxx::work& work) {
      work.exec(kCreate);
      return absl::OkStatus();
    });
    while (created.ok()) {
      absl::Status taken = Transaction([this](pqxx::work& work) { return Take(work); });
      if (!taken.ok() || epoch_ > 0) return taken;
      if (!options_.wait()) return absl::CancelledError("another server owns the database");
    }
    return created;
  }

  absl::Status Commit(const std::vector<RecordChange>& changes) override {
    absl::MutexLock lock(&mutex_);
    return Transaction([&](pqxx::work& work) {
      // Holds off a successor until this transaction is over.
      if (absl::Status owned = Show(work); !owned.ok()) return owned;
      for (const RecordChange& change : changes) {
        if (change.bytes.has_value()) {
          work.exec_params(
              "INSERT INTO lambert_records VALUES ($1, $2, $3) "
              "ON CONFLICT (kind, id) DO UPDATE SET bytes = EXCLUDED.bytes",
              change.kind, change.id, pqxx::binarystring(*change.bytes));
        } else {
          work.exec_params("DELETE FROM lambert_records WHERE kind = $1 AND id = $2", change.kind,
                           change.id);
        }
      }
      return absl::OkStatus();
    });
  }

  absl::StatusOr<std::string> Load(const std::string& kind, const std::string& id) override {
    absl::MutexLock lock(&mutex_);
    std::string bytes;
    absl::Status status = Transaction([&](pqxx::work& work) {
      const pqxx::result rows = work.exec_params(
          "SELECT bytes FROM lambert_records WHERE kind = $1 AND id = $2", kind, id);
      if (rows.empty()) return absl::NotFoundError(kind + "/" + id);
      bytes = pqxx::binarystring(rows[0][0]).str();
      return absl::OkStatus();
    });
    if (!status.ok()) return status;
    return bytes;
  }

  absl::StatusOr<std::map<std::string, std::string>> LoadAll(const std::string& kind) override {
    absl::MutexLock lock(&mutex_);
    std::map<std::string, std::string> records;
    absl::Status status = Transaction([&](pqxx::work& work) {
      records.clear();
      for (const auto& row :
           work.exec_params("SELECT id, bytes FROM lambert_records WHERE kind = $1", kind)) {
        records[row[0].as<std::string>()] = pqxx::binarystring(row[1]).str();
      }
      return absl::OkStatus();
    });
    if (!status.ok()) return status;
    return records;
  }

  absl::Status CheckOwner() override {
    absl::MutexLock lock(&mutex_);
    return Transaction([this](pqxx::work& work) { return Show(work); });
  }

  int64_t epoch() const override { return epoch_; }
  bool keeps() const override { return true; }

 private:
  using Body = std::function<absl::Status(pqxx::work&)>;

  // Runs `body` in a transaction, over again where the connection breaks. That is safe also where
  // it broke in the commit: all statements may be repeated, and the epoch keeps others out.
  absl::Status Transaction(const Body& body) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    const TimePoint give_up = SteadyNow() + options_.takeover;
    while (true) {
      try {
        if (connection_ == nullptr) {
          connection_ = std::make_unique<pqxx::connection>(options_.url);
        }
        pqxx::work work(*connection_);
        absl::Status status = body(work);
        if (status.ok()) work.commit();
        return status;
      } catch (const pqxx::broken_connection& error) {
        if (SteadyNow() >= give_up) return Lost(error.what());
      } catch (const pqxx::in_doubt_error& error) {
        if (SteadyNow() >= give_up) return Lost(error.what());
      } catch (const pqxx::sql_error& error) {
        // A database that shuts down ends its sessions with an error before it breaks them.
        if (connection_->is_open()) return Failed(error.what(), error.sqlstate());
        if (SteadyNow() >= give_up) return Lost(error.what());
      } catch (const std::exception& error) {
        return Failed(error.what());
      }
      connection_.reset();
      std::this_thread::sleep_for(kReconnectPause);
    }
  }

  // Sets the epoch where nobody owns the store.
  absl::Status Take(pqxx::work& work) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    const pqxx::result rows = work.exec_params(
        "UPDATE lambert_owner SET epoch = epoch + 1, seen = clock_timestamp() "
        "WHERE seen < clock_timestamp() - make_interval(secs => $1) RETURNING epoch",
        ToSeconds(options_.takeover));
    if (!rows.empty()) epoch_ = rows[0][0].as<int64_t>();
    return absl::OkStatus();
  }

  // Checks that this is the owner, shows that it is alive, and locks the row until the commit.
  absl::Status Show(pqxx::work& work) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    const pqxx::result rows = work.exec_params(
        "UPDATE lambert_owner SET seen = clock_timestamp() WHERE epoch = $1", epoch_);
    if (rows.affected_rows() > 0) return absl::OkStatus();
    return FencedError("the database", epoch_,
                       work.exec1("SELECT epoch FROM lambert_owner")[0].as<int64_t>());
  }

  static absl::Status Failed(const std::string& what, const std::string& sqlstate = "") {
    if (sqlstate == kDiskFull) {
      return MakeError(absl::StatusCode::kResourceExhausted,
                       {"STORE_FULL", "the database", FirstLine(what),
                        "delete jobs and scenes, or give the database more disk"});
    }
    return MakeError(absl::StatusCode::kInternal, {"STORE_FAILED", "the database", FirstLine(what),
                                                   "check --database and its server"});
  }

  static absl::Status Lost(const std::string& what) {
    return MakeError(absl::StatusCode::kUnavailable,
                     {"DATABASE_LOST", "the database", FirstLine(what),
                      "see that it runs, and start this server again"});
  }

  static std::string FirstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

  const PostgresOptions options_;
  absl::Mutex mutex_;
  std::unique_ptr<pqxx::connection> connection_ ABSL_GUARDED_BY(mutex_);  // null: broken
  int64_t epoch_ = 0;                                                     // set once, by Open
};

}  // namespace

absl::StatusOr<std::unique_ptr<RecordStore>> OpenPostgresRecordStore(
    const PostgresOptions& options) {
  auto store = std::make_unique<PostgresRecordStore>(options);
  if (absl::Status opened = store->Open(); !opened.ok()) return opened;
  return store;
}

}  // namespace lambert::server
