// What workers and merge shards are refused with.
#pragma once

#include <string>

#include "absl/status/status.h"

namespace lambert::server {

// UNAVAILABLE (SHUTTING_DOWN): the server is stopping.
absl::Status ShuttingDown();

// FAILED_PRECONDITION (UNIT_VERSION_UNSUPPORTED): `who` is of another version than the server.
absl::Status VersionUnsupported(const std::string& who, const std::string& theirs,
                                const std::string& ours);

}  // namespace lambert::server
