// Records in a SQLite database: the store of a coordinator on one machine.
#pragma once

#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "server/base/record_store.h"
#include "server/database/folder_lock.h"

namespace lambert::server {

// Opens the database file `path`, makes it where there is none, and takes the next epoch. Every
// commit is on the disk when it returns (write-ahead log, synchronous FULL); on a full disk the log
// is folded into the database and the commit tried once more before it is STORE_FULL. STORE_FAILED
// where the file is no such database. The store holds `lock`, if any, for as long as it lives.
absl::StatusOr<std::unique_ptr<RecordStore>> OpenSqliteRecordStore(
    const std::string& path, std::unique_ptr<FolderLock> lock = nullptr);

}  // namespace lambert::server
