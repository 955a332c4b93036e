#include "server/base/files.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "radiosity/core/error.h"
#include "server/base/failpoint.h"

namespace lambert::server {
namespace {

constexpr char kTemporarySuffix[] = ".tmp";

absl::Status WriteAll(int file, const std::string& path, const std::string& bytes) {
  size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n = write(file, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return FileError(path, errno);
    done += static_cast<size_t>(n);
  }
  if (fsync(file) != 0) return FileError(path, errno);
  return absl::OkStatus();
}

}  // namespace

absl::Status FileError(const std::string& path, int error_number) {
  const std::string what = std::strerror(error_number);
  if (error_number == ENOSPC || error_number == EDQUOT || error_number == EFBIG) {
    return MakeError(
        absl::StatusCode::kResourceExhausted,
        {"STORE_FULL", path, what, "delete jobs and scenes, or give the server more disk"});
  }
  if (error_number == ENOENT) {
    return MakeError(absl::StatusCode::kNotFound,
                     {"FILE_NOT_FOUND", path, what, "check the server's data folder"});
  }
  return MakeError(absl::StatusCode::kInternal,
                   {"STORE_FAILED", path, what, "check the server's data folder"});
}

absl::Status WriteFileAtomically(const std::string& path, const std::string& bytes) {
  // Two writers of one path must not share a temporary file.
  static std::atomic<uint64_t> counter{0};
  const std::string temporary =
      path + "." + std::to_string(counter.fetch_add(1)) + kTemporarySuffix;
  const int file = open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) return FileError(temporary, errno);
  absl::Status status = WriteAll(file, path, bytes);
  if (close(file) != 0 && status.ok()) status = FileError(path, errno);
  Failpoint("blob-before-rename");
  if (status.ok() && rename(temporary.c_str(), path.c_str()) != 0) status = FileError(path, errno);
  if (!status.ok()) {
    unlink(temporary.c_str());
    return status;
  }
  SyncFolder(std::filesystem::path(path).parent_path().string());
  Failpoint("blob-after-rename");
  return absl::OkStatus();
}

absl::StatusOr<std::string> ReadFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return FileError(path, errno != 0 ? errno : ENOENT);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  if (file.bad()) return FileError(path, EIO);
  return std::move(bytes).str();
}

absl::StatusOr<std::vector<std::string>> ListFiles(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (!entry.is_regular_file(error)) continue;
    if (entry.path().extension() == kTemporarySuffix) {
      std::filesystem::remove(entry.path(), error);
    } else {
      names.push_back(entry.path().filename().string());
    }
  }
  if (error) return FileError(folder, error.value());
  std::sort(names.begin(), names.end());
  return names;
}

absl::Status MakeFolder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return FileError(folder, error.value());
  return absl::OkStatus();
}

void SyncFolder(const std::string& folder) {
  const int file = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;
  fsync(file);
  close(file);
}

}  // namespace lambert::server
