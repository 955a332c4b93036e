#include "server/work/refusals.h"

#include "radiosity/core/error.h"

namespace lambert::server {

absl::Status ShuttingDown() {
  return MakeError(absl::StatusCode::kUnavailable, {"SHUTTING_DOWN", "lambert-server",
                                                    "the server is stopping", "try again later"});
}

absl::Status VersionUnsupported(const std::string& who, const std::string& theirs,
                                const std::string& ours) {
  return MakeError(absl::StatusCode::kFailedPrecondition,
                   {"UNIT_VERSION_UNSUPPORTED", who,
                    "it computes units as \"" + theirs + "\", the server wants \"" + ours + "\"",
                    "install the same version of lambert on both"});
}

}  // namespace lambert::server
