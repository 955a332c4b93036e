// What a worker says of an exception, which at the worst is memory exhausted.
#pragma once

#include <exception>
#include <string>

#include "absl/status/status.h"
#include "radiosity/core/error.h"

namespace lambert::worker {

inline absl::Status OutOfMemory(const std::exception& error) {
  return MakeError(
      absl::StatusCode::kResourceExhausted,
      {"OUT_OF_MEMORY", "worker", "not enough memory (" + std::string(error.what()) + ")",
       "give it more memory, or fewer slots"});
}

}  // namespace lambert::worker
