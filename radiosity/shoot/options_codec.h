// How shoot options travel to workers.
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "radiosity/shoot/options.h"

namespace lambert {

// Canonical bytes (docs/formats.md, "shoot options"): equal options give equal bytes.
std::string EncodeShootOptions(const ShootOptions& options);

// Fails with DATA_LOSS on other bytes, and as ShootOptions::Validate does; never crashes.
absl::StatusOr<ShootOptions> DecodeShootOptions(const std::string& bytes);

}  // namespace lambert
