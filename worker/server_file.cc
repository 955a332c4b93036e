#include "worker/server_file.h"

#include <fstream>

namespace lambert::worker {

std::string ReadServerFile(const std::string& path) {
  std::ifstream file(path);
  std::string address;
  std::getline(file, address);
  return address;
}

}  // namespace lambert::worker
