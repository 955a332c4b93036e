// The file in which a server says where it listens: lambert-server --address-file FILE.
#pragma once

#include <string>

namespace lambert::worker {

// The HOST:PORT that the first line of `path` holds; "" while there is no such file. The server
// replaces the file as a whole, so what is read is never half an address.
std::string ReadServerFile(const std::string& path);

}  // namespace lambert::worker
