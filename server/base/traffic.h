// What goes between a coordinator and its clients.
#pragma once

#include <atomic>
#include <cstdint>

namespace lambert::server {

// Thread safe, each number by itself.
struct Traffic {
  std::atomic<int64_t> uploaded_bytes{0};
  std::atomic<int64_t> downloaded_bytes{0};  // by workers too: patch sets
  std::atomic<int64_t> watchers{0};          // there now
};

}  // namespace lambert::server
