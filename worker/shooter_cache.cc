#include "worker/shooter_cache.h"

#include <algorithm>
#include <exception>
#include <utility>
#include <vector>

#include "radiosity/core/digest.h"
#include "radiosity/core/error.h"
#include "radiosity/gather/gather_units.h"
#include "radiosity/shoot/directions.h"
#include "radiosity/shoot/options_codec.h"
#include "worker/out_of_memory.h"

namespace lambert::worker {

ShooterCache::ShooterCache(FetchBlob fetch, ShooterFactory make, size_t capacity)
    : fetch_(std::move(fetch)), make_(std::move(make)), capacity_(capacity) {}

absl::StatusOr<std::shared_ptr<const Shooter>> ShooterCache::Get(const ShooterKey& key) {
  std::shared_ptr<Entry> entry;
  bool is_new = false;
  {
    absl::MutexLock lock(&mutex_);
    auto found = std::find_if(entries_.begin(), entries_.end(),
                              [&](const auto& known) { return known->key == key; });
    is_new = found == entries_.end();
    if (is_new) {
      entry = std::make_shared<Entry>();
      entry->key = key;
      entries_.push_front(entry);
      if (entries_.size() > capacity_) entries_.pop_back();
    } else {
      entry = *found;
      entries_.splice(entries_.begin(), entries_, found);
    }
  }
  if (is_new) {
    entry->shooter = Make(key);
    entry->ready.Notify();
    if (!entry->shooter.ok()) {
      absl::MutexLock lock(&mutex_);
      entries_.remove(entry);
    }
  }
  entry->ready.WaitForNotification();
  return entry->shooter;
}

absl::StatusOr<std::string> ShooterCache::Fetch(const std::string& sha256,
                                                int64_t size_bytes) const {
  absl::StatusOr<std::string> bytes = fetch_(sha256, size_bytes);
  if (!bytes.ok() || Sha256Hex(*bytes) == sha256) return bytes;
  return MakeError(absl::StatusCode::kDataLoss,
                   {"DIGEST_MISMATCH", "blob " + sha256, "other bytes arrived",
                    "check the network and the server's data folder"});
}

// The bytes are gone when this returns: the shooter needs their room.
absl::StatusOr<PatchSet> ShooterCache::Patches(const ShooterKey& key) const {
  absl::StatusOr<std::string> bytes = Fetch(key.patch_set_sha256, key.patch_set_bytes);
  if (!bytes.ok()) return bytes.status();
  return DecodePatchSet(*bytes);
}

absl::StatusOr<std::shared_ptr<const Shooter>> ShooterCache::Make(const ShooterKey& key) const try {
  if (!key.gather_task_sha256.empty()) {
    absl::StatusOr<std::string> bytes = Fetch(key.gather_task_sha256, key.gather_task_bytes);
    if (!bytes.ok()) return bytes.status();
    absl::StatusOr<GatherTask> task = DecodeGatherTask(*bytes);
    if (!task.ok()) return task.status();
    absl::StatusOr<PatchSet> patches = Patches(key);
    if (!patches.ok()) return patches.status();
    return MakeGatherShooter(std::make_shared<const PatchSet>(*std::move(patches)), *task);
  }
  absl::StatusOr<ShootOptions> options = DecodeShootOptions(key.shoot_options);
  if (!options.ok()) return options.status();
  absl::StatusOr<PatchSet> patches = Patches(key);
  if (!patches.ok()) return patches.status();
  // Units say what is shot; only densities ask which rooms are lit.
  if (!CountsPatches(*options)) patches->exitance_lm_per_m2 = std::vector<Rgb>();
  return make_(std::make_shared<const PatchSet>(*std::move(patches)), *options);
} catch (const std::exception& error) {
  return OutOfMemory(error);
}

}  // namespace lambert::worker
