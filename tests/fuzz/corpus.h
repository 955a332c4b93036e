// Where seeds are written.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "radiosity/core/digest.h"

namespace lambert {

class Corpus {
 public:
  explicit Corpus(std::string folder) : folder_(std::move(folder)) {}
  void Add(const std::string& target, const std::string& bytes) {
    const std::string folder = folder_ + "/" + target;
    std::filesystem::create_directories(folder);
    std::ofstream(folder + "/" + Sha256Hex(bytes).substr(0, 16), std::ios::binary) << bytes;
  }

 private:
  const std::string folder_;
};

}  // namespace lambert
