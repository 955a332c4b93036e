#include "server/database/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

#include "radiosity/core/error.h"
#include "server/base/files.h"

namespace lambert::server {

absl::StatusOr<std::unique_ptr<FolderLock>> FolderLock::Take(const std::string& folder) {
  const std::string path = folder + "/lambert.lock";
  const int file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file < 0) return FileError(path, errno);
  std::unique_ptr<FolderLock> lock(new FolderLock(file));
  if (flock(file, LOCK_EX | LOCK_NB) == 0) return lock;
  if (errno != EWOULDBLOCK) return FileError(path, errno);
  return MakeError(absl::StatusCode::kFailedPrecondition,
                   {"STORE_IN_USE", folder, "another lambert-server works in this folder",
                    "stop it, or give this one a folder of its own"});
}

FolderLock::~FolderLock() { close(file_); }

}  // namespace lambert::server
