// Files that are whole or not there.
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"

namespace lambert::server {

// Writes `path` through a temporary file in the same folder, fsync and rename: after a crash the
// old file or the new one is there, whole. RESOURCE_EXHAUSTED (STORE_FULL) where the disk is full.
absl::Status WriteFileAtomically(const std::string& path, const std::string& bytes);

// NOT_FOUND where there is no such file.
absl::StatusOr<std::string> ReadFile(const std::string& path);

// Names of the files in a folder, sorted; those that WriteFileAtomically left unfinished are
// removed.
absl::StatusOr<std::vector<std::string>> ListFiles(const std::string& folder);

// Makes a folder and those above it.
absl::Status MakeFolder(const std::string& folder);

// Makes a rename in `folder` outlast a crash. Best effort.
void SyncFolder(const std::string& folder);

// The status of a failed system call on `path`: STORE_FULL for ENOSPC, EDQUOT and EFBIG.
absl::Status FileError(const std::string& path, int error_number);

}  // namespace lambert::server
