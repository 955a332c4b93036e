// One process at a time in a folder.
#pragma once

#include <memory>
#include <string>

#include "absl/status/statusor.h"

namespace lambert::server {

// Holds a folder for as long as it lives, and no longer than its process.
class FolderLock {
 public:
  // FAILED_PRECONDITION (STORE_IN_USE) where another process, or object, has the folder. Requires:
  // the folder is there.
  static absl::StatusOr<std::unique_ptr<FolderLock>> Take(const std::string& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;

 private:
  explicit FolderLock(int file) : file_(file) {}
  const int file_;
};

}  // namespace lambert::server
