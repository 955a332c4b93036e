// Counts what a file holds and Lambert does not read, so that each is named once.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "radiosity/core/warning.h"

namespace lambert {

class UnreadFeatures {
 public:
  // One more `unit` ("material") with `feature` ("alpha blending"); `consequence` says what is done
  // instead ("taken as opaque").
  void Add(const std::string& feature, const std::string& unit, const std::string& consequence);

  // A warning FEATURE_NOT_READ for each feature, in alphabetical order:
  // "alpha blending (2 materials): taken as opaque".
  std::vector<Warning> Warnings() const;

 private:
  struct Entry {
    std::string unit, consequence;
    int64_t count = 0;
  };
  std::map<std::string, Entry> entries_;
};

}  // namespace lambert
