// Where a server is: told once, or in a file that may come later, and change.
#pragma once

#include <csignal>
#include <functional>
#include <string>

namespace lambert {

// Calls `use` with the HOST:PORT `server` or, where `server_file` is not "", with the first line of
// that file (lambert-server --address-file FILE) once it is there and whenever it has become
// another; until one of the blocked `signals` comes.
void FollowServer(const std::string& server, const std::string& server_file,
                  const sigset_t& signals, const std::function<void(const std::string&)>& use);

}  // namespace lambert
