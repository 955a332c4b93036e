// Patch sets made ready to shoot from: fetched by digest, built once, kept for the next unit.
#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "absl/synchronization/notification.h"
#include "radiosity/shoot/shooter.h"

namespace lambert::worker {

// How a shooter is made: Shooter::Create, or a fake in tests.
using ShooterFactory = std::function<absl::StatusOr<std::shared_ptr<const Shooter>>(
    std::shared_ptr<const PatchSet>, const ShootOptions&)>;

// What a shooter is made of, as a lease names it.
struct ShooterKey {
  std::string patch_set_sha256;
  int64_t patch_set_bytes = 0;
  std::string shoot_options;
  std::string gather_task_sha256 = {};  // "": shoots; else gathers (gather_units.h)
  int64_t gather_task_bytes = 0;

  bool operator==(const ShooterKey&) const = default;
};

// Gets the bytes of a blob.
using FetchBlob =
    std::function<absl::StatusOr<std::string>(const std::string& sha256, int64_t size_bytes)>;

// Thread safe. Threads that want the same shooter wait for the one that makes it.
class ShooterCache {
 public:
  // `capacity`: shooters that are kept, > 0; the least recently used goes first.
  ShooterCache(FetchBlob fetch, ShooterFactory make, size_t capacity);

  // DATA_LOSS where the bytes do not have the digest or are not what they should be; and what
  // fetching and making fail with. A failure is not kept: the next call tries again.
  absl::StatusOr<std::shared_ptr<const Shooter>> Get(const ShooterKey& key);

 private:
  struct Entry {
    ShooterKey key;
    absl::Notification ready;
    absl::StatusOr<std::shared_ptr<const Shooter>> shooter;  // once ready
  };
  absl::StatusOr<std::string> Fetch(const std::string& sha256, int64_t size_bytes) const;
  absl::StatusOr<PatchSet> Patches(const ShooterKey& key) const;
  absl::StatusOr<std::shared_ptr<const Shooter>> Make(const ShooterKey& key) const;

  const FetchBlob fetch_;
  const ShooterFactory make_;
  const size_t capacity_;
  absl::Mutex mutex_;
  std::list<std::shared_ptr<Entry>> entries_ ABSL_GUARDED_BY(mutex_);  // newest use first
};

}  // namespace lambert::worker
