#include "server/base/record_store.h"

#include <unistd.h>

#include "server/base/files.h"

namespace lambert::server {
namespace {

class NullRecordStore : public RecordStore {
 public:
  absl::Status Save(const std::string&, const std::string&, const std::string&) override {
    return absl::OkStatus();
  }
  void Delete(const std::string&, const std::string&) override {}
  absl::StatusOr<std::string> Load(const std::string& kind, const std::string& id) override {
    return absl::NotFoundError(kind + "/" + id);
  }
  absl::StatusOr<std::map<std::string, std::string>> LoadAll(const std::string&) override {
    return std::map<std::string, std::string>{};
  }
  bool keeps() const override { return false; }
};

class DirectoryRecordStore : public RecordStore {
 public:
  explicit DirectoryRecordStore(std::string folder) : folder_(std::move(folder)) {}

  absl::Status Save(const std::string& kind, const std::string& id,
                    const std::string& bytes) override {
    if (absl::Status made = MakeFolder(folder_ + "/" + kind); !made.ok()) return made;
    return WriteFileAtomically(Path(kind, id), bytes);
  }
  void Delete(const std::string& kind, const std::string& id) override {
    unlink(Path(kind, id).c_str());
  }
  absl::StatusOr<std::string> Load(const std::string& kind, const std::string& id) override {
    return ReadFile(Path(kind, id));
  }
  absl::StatusOr<std::map<std::string, std::string>> LoadAll(const std::string& kind) override {
    if (absl::Status made = MakeFolder(folder_ + "/" + kind); !made.ok()) return made;
    absl::StatusOr<std::vector<std::string>> ids = ListFiles(folder_ + "/" + kind);
    if (!ids.ok()) return ids.status();
    std::map<std::string, std::string> records;
    for (const std::string& id : *ids) {
      absl::StatusOr<std::string> bytes = Load(kind, id);
      if (!bytes.ok()) return bytes.status();
      records[id] = *std::move(bytes);
    }
    return records;
  }
  bool keeps() const override { return true; }

 private:
  std::string Path(const std::string& kind, const std::string& id) const {
    return folder_ + "/" + kind + "/" + id;
  }
  const std::string folder_;
};

}  // namespace

std::unique_ptr<RecordStore> MakeNullRecordStore() { return std::make_unique<NullRecordStore>(); }

std::unique_ptr<RecordStore> MakeDirectoryRecordStore(const std::string& folder) {
  return std::make_unique<DirectoryRecordStore>(folder);
}

}  // namespace lambert::server
