// What a worker has done since it was made, and does now.
#pragma once

#include <atomic>
#include <cstdint>

namespace lambert::worker {

// Thread safe, each number by itself.
struct WorkerCounters {
  std::atomic<int64_t> units_done{0}, units_failed{0};
  std::atomic<int64_t> rays{0};              // of units that are done
  std::atomic<int64_t> run_microseconds{0};  // that slots spent on them
  std::atomic<int64_t> result_bytes{0};      // that were sent
  std::atomic<int64_t> patch_bytes{0};       // that were fetched
  std::atomic<int64_t> running{0};           // units that run now
  std::atomic<bool> in_session{false};       // the server knows this worker
};

}  // namespace lambert::worker
