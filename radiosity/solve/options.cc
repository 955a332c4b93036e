#include "radiosity/solve/options.h"

#include <cmath>
#include <string>

#include "radiosity/core/error.h"

namespace lambert {
namespace {

absl::Status FieldError(const std::string& field, const std::string& message,
                        const std::string& hint) {
  return MakeError(absl::StatusCode::kInvalidArgument, {"FIELD_INVALID", field, message, hint});
}

}  // namespace

absl::Status SolveOptions::Validate() const {
  if (!(max_error >= 0) || !std::isfinite(max_error)) {
    return FieldError("max-error", "it is negative or not finite",
                      "use a relative error such as 0.03, or 0 for none");
  }
  if (max_rays < 0) return FieldError("max-rays", "it is negative", "use 0 for no budget");
  if (!(max_time_s >= 0) || !std::isfinite(max_time_s)) {
    return FieldError("max-time", "it is negative or not finite",
                      "use seconds, or 0 for no budget");
  }
  if (!(unsent_tolerance >= 0) || !(unsent_tolerance < 1)) {
    return FieldError("unsent-tolerance", "it is not in 0..1", "use 1e-9");
  }
  if (max_steps < 1) return FieldError("max-steps", "it is under 1", "use 1000000");
  return shoot.Validate();
}

}  // namespace lambert
