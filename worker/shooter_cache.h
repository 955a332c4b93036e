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

// Gets the bytes of a patch set.
using FetchPatches =
    std::function<absl::StatusOr<std::string>(const std::string& sha256, int64_t size_bytes)>;

// Thread safe. Threads that want the same shooter wait for the one that makes it.
class ShooterCache {
 public:
  // `capacity`: shooters that are kept, > 0; the least recently used goes first.
  ShooterCache(FetchPatches fetch, ShooterFactory make, size_t capacity);

  // DATA_LOSS where the bytes do not have the digest or are no patch set; and what fetching and
  // making fail with. A failure is not kept: the next call tries again.
  absl::StatusOr<std::shared_ptr<const Shooter>> Get(const std::string& sha256, int64_t size_bytes,
                                                     const std::string& shoot_options);

 private:
  struct Entry {
    std::string sha256, shoot_options;
    absl::Notification ready;
    absl::StatusOr<std::shared_ptr<const Shooter>> shooter;  // once ready
  };
  absl::StatusOr<PatchSet> Patches(const std::string& sha256, int64_t size_bytes) const;
  absl::StatusOr<std::shared_ptr<const Shooter>> Make(const std::string& sha256, int64_t size_bytes,
                                                      const std::string& shoot_options) const;

  const FetchPatches fetch_;
  const ShooterFactory make_;
  const size_t capacity_;
  absl::Mutex mutex_;
  std::list<std::shared_ptr<Entry>> entries_ ABSL_GUARDED_BY(mutex_);  // newest use first
};

}  // namespace lambert::worker
