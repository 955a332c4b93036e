// What a merge shard has done since it was made, and does now.
#pragma once

#include <atomic>
#include <cstdint>

namespace lambert::server {

// Thread safe, each number by itself.
struct MergeCounters {
  std::atomic<int64_t> parts_accepted{0}, parts_duplicate{0}, parts_split{0}, parts_refused{0};
  std::atomic<int64_t> part_bytes{0};          // of all parts that arrived
  std::atomic<int64_t> merge_microseconds{0};  // spent on checking and merging parts
  std::atomic<int64_t> sums{0};                // of steps that were whole
  std::atomic<bool> in_session{false};         // the server knows this shard
};

}  // namespace lambert::server
