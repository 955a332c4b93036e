// A file that is read again when it has changed.
#pragma once

#include <sys/stat.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "net/credentials.h"

namespace lambert::server {

// What `parse` makes of a file's text, as it is now. A file that has become bad is told to `log`,
// and its last good state holds. Thread safe.
template <typename T>
class FollowedFile {
 public:
  using Parse = std::function<absl::StatusOr<T>(const std::string& text, const std::string& path)>;
  using Log = std::function<void(const std::string&)>;

  // `option` names the file in errors. Fails as ReadCredential and `parse` do.
  static absl::StatusOr<std::unique_ptr<FollowedFile>> Open(const std::string& option,
                                                            const std::string& path, Parse parse,
                                                            Log log) {
    std::unique_ptr<FollowedFile> file(
        new FollowedFile(option, path, std::move(parse), std::move(log)));
    if (absl::Status status = file->Read(file->LookAtFile()); !status.ok()) return status;
    return file;
  }

  std::shared_ptr<const T> Get() {
    const Stamp stamp = LookAtFile();
    bool changed = false;
    {
      absl::MutexLock lock(&mutex_);
      changed = stamp_ != stamp;
    }
    if (changed) {
      const absl::Status read = Read(stamp);
      log_(read.ok() ? path_ + " was read again" : std::string(read.message()));
    }
    absl::MutexLock lock(&mutex_);
    return content_;
  }

 private:
  struct Stamp {
    int64_t seconds = 0, nanoseconds = 0, size = -1, inode = 0;
    bool operator==(const Stamp&) const = default;
  };

  FollowedFile(std::string option, std::string path, Parse parse, Log log)
      : option_(std::move(option)),
        path_(std::move(path)),
        parse_(std::move(parse)),
        log_(std::move(log)) {}

  Stamp LookAtFile() const {
    struct stat info {};
    if (stat(path_.c_str(), &info) != 0) return {};
    return {info.st_mtim.tv_sec, info.st_mtim.tv_nsec, info.st_size,
            static_cast<int64_t>(info.st_ino)};
  }

  absl::Status Read(const Stamp& stamp) {
    absl::StatusOr<std::string> text = ReadCredential(option_, path_);
    absl::StatusOr<T> content = text.ok() ? parse_(*text, path_) : text.status();
    absl::MutexLock lock(&mutex_);
    stamp_ = stamp;
    if (!content.ok()) return content.status();
    content_ = std::make_shared<const T>(*std::move(content));
    return absl::OkStatus();
  }

  const std::string option_, path_;
  const Parse parse_;
  const Log log_;
  absl::Mutex mutex_;
  Stamp stamp_ ABSL_GUARDED_BY(mutex_);
  std::shared_ptr<const T> content_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace lambert::server
