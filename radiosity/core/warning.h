// What a user should know of input that was used, but not as it may have been meant.
#pragma once

#include <string>

namespace lambert {

struct Warning {
  std::string reason;   // stable, UPPER_SNAKE_CASE: "ZERO_AREA_PATCHES", "FEATURE_NOT_READ"
  std::string message;  // "3 triangles without area were left out"
  bool operator==(const Warning&) const = default;
};

}  // namespace lambert
