#include "net/follow_server.h"

#include <ctime>
#include <fstream>

namespace lambert {
namespace {

// The server replaces the file as a whole, so what is read is never half an address.
std::string FirstLine(const std::string& path) {
  std::string line;
  std::getline(std::ifstream(path), line);
  return line;
}

}  // namespace

void FollowServer(const std::string& server, const std::string& server_file,
                  const sigset_t& signals, const std::function<void(const std::string&)>& use) {
  constexpr timespec kLookAgain = {1, 0};
  std::string address;
  do {
    const std::string named = server_file.empty() ? server : FirstLine(server_file);
    if (named.empty() || named == address) continue;
    address = named;
    use(address);
  } while (sigtimedwait(&signals, nullptr, &kLookAgain) < 0);
}

}  // namespace lambert
