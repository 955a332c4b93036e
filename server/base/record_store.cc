#include "server/base/record_store.h"

#include "radiosity/core/error.h"

namespace lambert::server {
namespace {

class NullRecordStore : public RecordStore {
 public:
  absl::Status Commit(const std::vector<RecordChange>&) override { return absl::OkStatus(); }
  absl::StatusOr<std::string> Load(const std::string& kind, const std::string& id) override {
    return absl::NotFoundError(kind + "/" + id);
  }
  absl::StatusOr<std::map<std::string, std::string>> LoadAll(const std::string&) override {
    return std::map<std::string, std::string>{};
  }
  absl::Status CheckOwner() override { return absl::OkStatus(); }
  int64_t epoch() const override { return 1; }
  bool keeps() const override { return false; }
};

}  // namespace

std::unique_ptr<RecordStore> MakeNullRecordStore() { return std::make_unique<NullRecordStore>(); }

absl::Status FencedError(const std::string& store, int64_t own_epoch, int64_t epoch) {
  return MakeError(absl::StatusCode::kUnavailable,
                   {"FENCED", store,
                    "another server has taken over (epoch " + std::to_string(epoch) +
                        ", this one had " + std::to_string(own_epoch) + ")",
                    "call that server; this one ends"});
}

absl::Status DamagedRecord(const std::string& kind, const std::string& id) {
  return MakeError(absl::StatusCode::kDataLoss,
                   {"RECORD_CORRUPT", kind + "/" + id, "the stored record cannot be read",
                    "restore the server's data folder from a copy, or delete the record"});
}

bool IsOwnershipLost(const absl::Status& status) {
  const std::string reason = ReasonOf(status);
  return reason == "FENCED" || reason == "DATABASE_LOST";
}

}  // namespace lambert::server
