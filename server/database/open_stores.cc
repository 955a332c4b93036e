#include "server/database/open_stores.h"

#include <utility>

#include "absl/strings/match.h"
#include "radiosity/core/error.h"
#include "server/base/files.h"
#include "server/database/folder_lock.h"
#include "server/database/postgres_record_store.h"
#include "server/database/sqlite_record_store.h"

namespace lambert::server {
namespace {

absl::StatusOr<std::unique_ptr<RecordStore>> OpenRecords(const StoreOptions& options) {
  if (options.database.empty()) {
    absl::StatusOr<std::unique_ptr<FolderLock>> lock = FolderLock::Take(options.data_folder);
    if (!lock.ok()) return lock.status();
    return OpenSqliteRecordStore(options.data_folder + "/lambert.db", *std::move(lock));
  }
  if (!absl::StartsWith(options.database, "postgresql://")) {
    return MakeError(absl::StatusCode::kInvalidArgument,
                     {"FIELD_INVALID", "--database", "is no address of a PostgreSQL database",
                      "give postgresql://USER@HOST/DATABASE, or leave it out"});
  }
  PostgresOptions postgres;
  postgres.url = options.database;
  postgres.wait = options.wait;
  return OpenPostgresRecordStore(postgres);
}

}  // namespace

absl::StatusOr<Stores> OpenStores(const StoreOptions& options) {
  if (options.data_folder.empty()) {
    return MakeError(absl::StatusCode::kInvalidArgument,
                     {"FIELD_INVALID", "--database", "holds records only, not the bytes of scenes",
                      "give --data DIR too, a folder that all servers of the database share"});
  }
  if (absl::Status made = MakeFolder(options.data_folder); !made.ok()) return made;
  absl::StatusOr<std::unique_ptr<RecordStore>> records = OpenRecords(options);
  if (!records.ok()) return records.status();
  // Only now: it removes what the owner before left half written.
  absl::StatusOr<std::unique_ptr<BlobStore>> blobs = MakeDirectoryBlobStore(options.data_folder);
  if (!blobs.ok()) return blobs.status();
  return Stores{*std::move(blobs), *std::move(records)};
}

}  // namespace lambert::server
