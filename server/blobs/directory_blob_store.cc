#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <set>

#include "absl/synchronization/mutex.h"
#include "radiosity/core/digest.h"
#include "radiosity/core/error.h"
#include "server/base/failpoint.h"
#include "server/base/files.h"
#include "server/blobs/blob_store.h"

namespace lambert::server {
namespace {

// A file mapped read-only: paged in as it is read, and valid after the file was unlinked.
class MappedBlob : public Blob {
 public:
  static absl::StatusOr<std::shared_ptr<const MappedBlob>> Open(const std::string& path) {
    const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) return FileError(path, errno);
    struct stat info {};
    if (fstat(file, &info) != 0) {
      close(file);
      return FileError(path, errno);
    }
    const size_t size = static_cast<size_t>(info.st_size);
    void* data = size == 0 ? nullptr : mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file, 0);
    const int error = errno;
    close(file);
    if (data == MAP_FAILED) return FileError(path, error);
    return std::shared_ptr<const MappedBlob>(new MappedBlob(data, size));
  }
  ~MappedBlob() override {
    if (data_ != nullptr) munmap(data_, size_);
  }
  absl::string_view bytes() const override { return {static_cast<const char*>(data_), size_}; }

 private:
  MappedBlob(void* data, size_t size) : data_(data), size_(size) {}
  void* const data_;
  const size_t size_;
};

class FilePartialBlob : public PartialBlob {
 public:
  FilePartialBlob(std::string path, int file, int64_t size)
      : path_(std::move(path)), file_(file), size_(size) {}
  ~FilePartialBlob() override { close(file_); }
  int64_t size() const override { return size_; }
  const std::string& path() const { return path_; }
  absl::Status Append(absl::string_view data) override {
    int64_t end = size_;
    while (!data.empty()) {
      const ssize_t n = pwrite(file_, data.data(), data.size(), end);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) return FileError(path_, errno);
      data.remove_prefix(static_cast<size_t>(n));
      end += n;
    }
    size_ = end;
    return absl::OkStatus();
  }
  absl::Status Sync() {
    if (ftruncate(file_, size_) != 0 || fsync(file_) != 0) return FileError(path_, errno);
    return absl::OkStatus();
  }

 private:
  const std::string path_;
  const int file_;
  int64_t size_;
};

class DirectoryBlobStore : public BlobStore {
 public:
  DirectoryBlobStore(std::string blobs, std::string partial)
      : blobs_(std::move(blobs)), partial_(std::move(partial)) {}

  bool Has(const std::string& sha256) const override {
    return access((blobs_ + sha256).c_str(), R_OK) == 0;
  }

  absl::StatusOr<std::shared_ptr<const Blob>> Get(const std::string& sha256) override {
    absl::StatusOr<std::shared_ptr<const MappedBlob>> blob = MappedBlob::Open(blobs_ + sha256);
    if (absl::IsNotFound(blob.status())) return BlobNotFound(sha256);
    if (!blob.ok()) return blob.status();
    if (IsVerified(sha256)) return *blob;
    if (Sha256Hex((*blob)->bytes().data(), (*blob)->bytes().size()) != sha256) {
      return MakeError(absl::StatusCode::kDataLoss,
                       {"BLOB_CORRUPT", "blobs/" + sha256, "the stored bytes have changed",
                        "delete the file in the server's data folder and upload it again"});
    }
    MarkVerified(sha256);
    return *blob;
  }

  absl::Status Put(const std::string& sha256, std::string bytes) override {
    if (Has(sha256)) return absl::OkStatus();
    absl::Status status = WriteFileAtomically(blobs_ + sha256, bytes);
    if (status.ok()) MarkVerified(sha256);
    return status;
  }

  void Delete(const std::string& sha256) override {
    unlink((blobs_ + sha256).c_str());
    absl::MutexLock lock(&mutex_);
    verified_.erase(sha256);
  }

  std::vector<StoredBlob> List() const override {
    std::vector<StoredBlob> blobs;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(blobs_, error)) {
      const std::string name = entry.path().filename().string();
      if (!IsSha256Hex(name)) continue;
      const auto written = entry.last_write_time(error);
      if (!error) blobs.push_back({name, std::filesystem::file_time_type::clock::now() - written});
    }
    return blobs;
  }

  absl::StatusOr<std::unique_ptr<PartialBlob>> OpenPartial(const std::string& key) override {
    const std::string path = partial_ + key;
    const int file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (file < 0) return FileError(path, errno);
    struct stat info {};
    if (fstat(file, &info) != 0) {
      close(file);
      return FileError(path, errno);
    }
    return std::make_unique<FilePartialBlob>(path, file, info.st_size);
  }

  absl::Status Commit(std::unique_ptr<PartialBlob> partial, const std::string& sha256) override {
    const std::string path = static_cast<FilePartialBlob&>(*partial).path();
    absl::Status synced = static_cast<FilePartialBlob&>(*partial).Sync();
    partial.reset();
    if (!synced.ok()) return synced;
    absl::StatusOr<std::shared_ptr<const MappedBlob>> blob = MappedBlob::Open(path);
    if (!blob.ok()) return blob.status();
    if (Sha256Hex((*blob)->bytes().data(), (*blob)->bytes().size()) != sha256) {
      unlink(path.c_str());
      return DigestMismatch(sha256);
    }
    Failpoint("upload-before-rename");
    if (rename(path.c_str(), (blobs_ + sha256).c_str()) != 0) return FileError(path, errno);
    SyncFolder(blobs_);
    Failpoint("upload-after-rename");
    MarkVerified(sha256);
    return absl::OkStatus();
  }

  void DropPartial(const std::string& key) override { unlink((partial_ + key).c_str()); }

 private:
  bool IsVerified(const std::string& sha256) const {
    absl::MutexLock lock(&mutex_);
    return verified_.count(sha256) > 0;
  }
  void MarkVerified(const std::string& sha256) {
    absl::MutexLock lock(&mutex_);
    verified_.insert(sha256);
  }

  const std::string blobs_, partial_;  // folders, with a slash at the end
  mutable absl::Mutex mutex_;
  std::set<std::string> verified_ ABSL_GUARDED_BY(mutex_);  // hashed since the server started
};

}  // namespace

absl::StatusOr<std::unique_ptr<BlobStore>> MakeDirectoryBlobStore(const std::string& folder) {
  const std::string blobs = folder + "/blobs/", partial = folder + "/partial/";
  for (const std::string& path : {blobs, partial}) {
    if (absl::Status made = MakeFolder(path); !made.ok()) return made;
    // Also removes what a crashed server left half written.
    if (auto listed = ListFiles(path); !listed.ok()) return listed.status();
  }
  return std::make_unique<DirectoryBlobStore>(blobs, partial);
}

}  // namespace lambert::server
