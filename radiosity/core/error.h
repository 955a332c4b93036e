// Errors that a user reads: one line that says where, what, and what to do.
#pragma once

#include <optional>
#include <string>

#include "absl/status/status.h"

namespace lambert {

struct ErrorDetail {
  std::string reason;   // stable, UPPER_SNAKE_CASE: "SCENE_INVALID"
  std::string where;    // "room.glb, accessor 3"
  std::string message;  // "count 12 runs past the end of its buffer view"
  std::string hint;     // "export the file again"
};

// A status whose message reads `WHERE: MESSAGE; HINT` and that carries `detail` along.
absl::Status MakeError(absl::StatusCode code, const ErrorDetail& detail);

// The detail that MakeError stored, or nullopt for a status made otherwise.
std::optional<ErrorDetail> GetErrorDetail(const absl::Status& status);
// The reason of that detail, or "".
std::string ReasonOf(const absl::Status& status);

// For a scene that cannot be used: INVALID_ARGUMENT with reason SCENE_INVALID.
absl::Status SceneError(const std::string& where, const std::string& message,
                        const std::string& hint);

}  // namespace lambert
