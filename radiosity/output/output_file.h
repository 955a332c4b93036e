// Files that appear whole or not at all.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace lambert {

// Writes to `PATH.partial` and renames it to PATH when committed. A file that is never committed is
// removed. Errors read "PATH: WHAT; DO THIS" (reason OUTPUT_FAILED): a full disk, a missing right.
// One thread at a time.
class OutputFile {
 public:
  static absl::StatusOr<OutputFile> Create(const std::string& path);
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&&) = delete;
  ~OutputFile();

  absl::Status Append(const std::string& bytes);
  absl::Status Commit();

 private:
  OutputFile(std::string path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}
  std::string path_;
  int descriptor_ = -1;  // -1: committed or moved from
};

// Create, Append and Commit in one.
absl::Status WriteOutputFile(const std::string& path, const std::string& bytes);

// The same where there are bytes; else their error.
absl::Status WriteIfOk(const std::string& path, const absl::StatusOr<std::string>& bytes);

// The error that a failed system call left in errno, told about `path`.
absl::Status OutputError(const std::string& path);

// Writes all of `bytes` to an open file; `path` is for the error.
absl::Status WriteAll(int descriptor, const std::string& path, const std::string& bytes);

// Makes the folder and those above it; no error where it is there.
absl::Status MakeOutputFolder(const std::string& folder);

}  // namespace lambert
