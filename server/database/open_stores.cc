#include "server/database/open_stores.h"

#include <utility>

#include "server/base/files.h"
#include "server/database/folder_lock.h"
#include "server/database/sqlite_record_store.h"

namespace lambert::server {

absl::StatusOr<Stores> OpenStores(const std::string& data_folder) {
  if (absl::Status made = MakeFolder(data_folder); !made.ok()) return made;
  absl::StatusOr<std::unique_ptr<FolderLock>> lock = FolderLock::Take(data_folder);
  if (!lock.ok()) return lock.status();
  absl::StatusOr<std::unique_ptr<BlobStore>> blobs = MakeDirectoryBlobStore(data_folder);
  if (!blobs.ok()) return blobs.status();
  absl::StatusOr<std::unique_ptr<RecordStore>> records =
      OpenSqliteRecordStore(data_folder + "/lambert.db", *std::move(lock));
  if (!records.ok()) return records.status();
  return Stores{*std::move(blobs), *std::move(records)};
}

}  // namespace lambert::server
