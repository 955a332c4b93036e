// Small named records (jobs, scenes, checkpoints) that a restarted coordinator finds again.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "absl/status/statusor.h"

namespace lambert::server {

// Thread safe for different records; one record is written by one thread at a time. `kind` and `id`
// are names that the server made or checked: [a-z0-9-]+.
class RecordStore {
 public:
  virtual ~RecordStore() = default;
  virtual absl::Status Save(const std::string& kind, const std::string& id,
                            const std::string& bytes) = 0;
  virtual void Delete(const std::string& kind, const std::string& id) = 0;
  // NOT_FOUND where there is none.
  virtual absl::StatusOr<std::string> Load(const std::string& kind, const std::string& id) = 0;
  // All records of a kind by id: what a restart finds.
  virtual absl::StatusOr<std::map<std::string, std::string>> LoadAll(const std::string& kind) = 0;
  // False where Save keeps nothing, so that nobody need make what would be saved.
  virtual bool keeps() const = 0;
};

// Keeps nothing: the owners' memory is all there is.
std::unique_ptr<RecordStore> MakeNullRecordStore();

// Keeps each record in the file `folder`/kind/id.
std::unique_ptr<RecordStore> MakeDirectoryRecordStore(const std::string& folder);

}  // namespace lambert::server
