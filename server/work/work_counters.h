// What a work table has done since it was made. Numbers only grow.
#pragma once

#include <atomic>
#include <cstdint>

namespace lambert::server {

// Thread safe, each number by itself.
struct WorkCounters {
  std::atomic<int64_t> leases_granted{0};
  std::atomic<int64_t> leases_repeated{0};  // of those: units that had been lent before
  std::atomic<int64_t> leases_failed{0};    // ended by an error, a bad result or a lost worker
  std::atomic<int64_t> results_accepted{0}, results_duplicate{0}, results_obsolete{0},
      results_refused{0};
  std::atomic<int64_t> result_bytes{0};        // of all results that arrived
  std::atomic<int64_t> rays{0};                // of accepted results
  std::atomic<int64_t> run_microseconds{0};    // that slots spent on accepted results
  std::atomic<int64_t> merge_microseconds{0};  // spent on checking and merging results
};

}  // namespace lambert::server
