#include "radiosity/output/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "radiosity/core/error.h"

namespace lambert {
namespace {

std::string PartialPath(const std::string& path) { return path + ".partial"; }

const char* Hint(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
      return "free some space or choose another folder with -o";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a folder that you may write to with -o";
    case ENOENT:
    case ENOTDIR:
    case EEXIST:
      return "give a folder with -o, not a file";
    default:
      return "choose another folder with -o";
  }
}

absl::Status OutputErrorOf(const std::string& path, int error) {
  auto code = error == ENOSPC || error == EDQUOT ? absl::StatusCode::kResourceExhausted
                                                 : absl::StatusCode::kFailedPrecondition;
  return MakeError(
      code, {"OUTPUT_FAILED", path,
             "cannot be written (" + std::generic_category().message(error) + ")", Hint(error)});
}

}  // namespace

absl::Status OutputError(const std::string& path) { return OutputErrorOf(path, errno); }

absl::Status WriteAll(int descriptor, const std::string& path, const std::string& bytes) {
  size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = write(descriptor, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return OutputError(path);
    done += static_cast<size_t>(count);
  }
  return absl::OkStatus();
}

absl::StatusOr<OutputFile> OutputFile::Create(const std::string& path) {
  int descriptor = open(PartialPath(path).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) return OutputError(path);
  return OutputFile(path, descriptor);
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(other.descriptor_) {
  other.descriptor_ = -1;
}

OutputFile::~OutputFile() {
  if (descriptor_ < 0) return;
  close(descriptor_);
  unlink(PartialPath(path_).c_str());
}

absl::Status OutputFile::Append(const std::string& bytes) {
  return WriteAll(descriptor_, path_, bytes);
}

absl::Status OutputFile::Commit() {
  // Some file systems tell of a full disk only here.
  if (fsync(descriptor_) != 0 && errno != EINVAL) return OutputError(path_);
  if (rename(PartialPath(path_).c_str(), path_.c_str()) != 0) return OutputError(path_);
  close(descriptor_);
  descriptor_ = -1;
  return absl::OkStatus();
}

absl::Status WriteOutputFile(const std::string& path, const std::string& bytes) {
  absl::StatusOr<OutputFile> file = OutputFile::Create(path);
  if (!file.ok()) return file.status();
  if (absl::Status status = file->Append(bytes); !status.ok()) return status;
  return file->Commit();
}

absl::Status WriteIfOk(const std::string& path, const absl::StatusOr<std::string>& bytes) {
  return bytes.ok() ? WriteOutputFile(path, *bytes) : bytes.status();
}

absl::Status MakeOutputFolder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return OutputErrorOf(folder, error.value());
  return absl::OkStatus();
}

}  // namespace lambert
