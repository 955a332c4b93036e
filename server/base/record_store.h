// Small named records (jobs, scenes, resume points) that a restarted coordinator finds again.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"

namespace lambert::server {

// What becomes of one record. `kind` and `id` are names that the server made or checked:
// [a-z0-9.-]+.
struct RecordChange {
  std::string kind, id;
  std::optional<std::string> bytes;  // absent: the record goes
};

// Thread safe. One coordinator at a time owns a store: each takes the next epoch when it opens it,
// and from then on every call of the one before fails with FENCED.
class RecordStore {
 public:
  virtual ~RecordStore() = default;
  // Makes all changes or none; when it returns OK, they outlast a crash. STORE_FULL, STORE_FAILED,
  // FENCED, DATABASE_LOST.
  virtual absl::Status Commit(const std::vector<RecordChange>& changes) = 0;
  // NOT_FOUND where there is none.
  virtual absl::StatusOr<std::string> Load(const std::string& kind, const std::string& id) = 0;
  // All records of a kind by id: what a restart finds.
  virtual absl::StatusOr<std::map<std::string, std::string>> LoadAll(const std::string& kind) = 0;
  // OK while this coordinator owns the store. FENCED, DATABASE_LOST.
  virtual absl::Status CheckOwner() = 0;
  // Grows with each coordinator that opens the store, > 0.
  virtual int64_t epoch() const = 0;
  // False where Commit keeps nothing, so that nobody need make what would be saved.
  virtual bool keeps() const = 0;
};

// Keeps nothing: the owners' memory is all there is.
std::unique_ptr<RecordStore> MakeNullRecordStore();

// UNAVAILABLE (FENCED): a coordinator of a later epoch owns `store`.
absl::Status FencedError(const std::string& store, int64_t own_epoch, int64_t epoch);

// DATA_LOSS (RECORD_CORRUPT): the bytes of a record are none of its kind.
absl::Status DamagedRecord(const std::string& kind, const std::string& id);

// True for FENCED and DATABASE_LOST: the coordinator may write nothing any more and has to end. Its
// jobs stay as they are.
bool IsOwnershipLost(const absl::Status& status);

}  // namespace lambert::server
