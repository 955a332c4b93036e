#include "worker/shooter_cache.h"

#include <algorithm>
#include <exception>
#include <utility>
#include <vector>

#include "radiosity/core/digest.h"
#include "radiosity/core/error.h"
#include "radiosity/shoot/options_codec.h"
#include "worker/out_of_memory.h"

namespace lambert::worker {

ShooterCache::ShooterCache(FetchPatches fetch, ShooterFactory make, size_t capacity)
    : fetch_(std::move(fetch)), make_(std::move(make)), capacity_(capacity) {}

absl::StatusOr<std::shared_ptr<const Shooter>> ShooterCache::Get(const std::string& sha256,
                                                                 int64_t size_bytes,
                                                                 const std::string& shoot_options) {
  std::shared_ptr<Entry> entry;
  bool is_new = false;
  {
    absl::MutexLock lock(&mutex_);
    auto found = std::find_if(entries_.begin(), entries_.end(), [&](const auto& known) {
      return known->sha256 == sha256 && known->shoot_options == shoot_options;
    });
    is_new = found == entries_.end();
    if (is_new) {
      entry = std::make_shared<Entry>();
      entry->sha256 = sha256;
      entry->shoot_options = shoot_options;
      entries_.push_front(entry);
      if (entries_.size() > capacity_) entries_.pop_back();
    } else {
      entry = *found;
      entries_.splice(entries_.begin(), entries_, found);
    }
  }
  if (is_new) {
    entry->shooter = Make(sha256, size_bytes, shoot_options);
    entry->ready.Notify();
    if (!entry->shooter.ok()) {
      absl::MutexLock lock(&mutex_);
      entries_.remove(entry);
    }
  }
  entry->ready.WaitForNotification();
  return entry->shooter;
}

// The bytes are gone when this returns: the shooter needs their room.
absl::StatusOr<PatchSet> ShooterCache::Patches(const std::string& sha256,
                                               int64_t size_bytes) const {
  absl::StatusOr<std::string> bytes = fetch_(sha256, size_bytes);
  if (!bytes.ok()) return bytes.status();
  if (Sha256Hex(*bytes) != sha256) {
    return MakeError(absl::StatusCode::kDataLoss,
                     {"DIGEST_MISMATCH", "patch set " + sha256, "other bytes arrived",
                      "check the network and the server's data folder"});
  }
  absl::StatusOr<PatchSet> patches = DecodePatchSet(*bytes);
  if (patches.ok()) patches->exitance_lm_per_m2 = std::vector<Rgb>();  // units say what is shot
  return patches;
}

absl::StatusOr<std::shared_ptr<const Shooter>> ShooterCache::Make(
    const std::string& sha256, int64_t size_bytes, const std::string& shoot_options) const try {
  absl::StatusOr<ShootOptions> options = DecodeShootOptions(shoot_options);
  if (!options.ok()) return options.status();
  absl::StatusOr<PatchSet> patches = Patches(sha256, size_bytes);
  if (!patches.ok()) return patches.status();
  return make_(std::make_shared<const PatchSet>(*std::move(patches)), *options);
} catch (const std::exception& error) {
  return OutOfMemory(error);
}

}  // namespace lambert::worker
