#include "server/base/failpoint.h"

#include <signal.h>

#include <atomic>
#include <cstdlib>
#include <string>

namespace lambert::server {
namespace {

struct Wanted {
  std::string name;
  std::atomic<int> passages{0};  // still to come
};

Wanted& TheWanted() {
  static Wanted wanted;
  [[maybe_unused]] static const bool once = [] {
    const char* value = std::getenv("LAMBERT_FAILPOINT");
    const std::string text = value == nullptr ? "" : value;
    const size_t colon = text.find(':');
    wanted.name = text.substr(0, colon);
    wanted.passages = colon == std::string::npos ? 1 : std::atoi(text.c_str() + colon + 1);
    return true;
  }();
  return wanted;
}

}  // namespace

void Failpoint(const char* name) {
  Wanted& wanted = TheWanted();
  if (wanted.name == name && wanted.passages.fetch_sub(1) == 1) raise(SIGKILL);
}

}  // namespace lambert::server
