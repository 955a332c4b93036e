#include "radiosity/core/error.h"

#include "absl/strings/cord.h"

namespace lambert {
namespace {

constexpr char kPayloadType[] = "lambert/error-detail";
constexpr char kSeparator = '\0';

}  // namespace

absl::Status MakeError(absl::StatusCode code, const ErrorDetail& detail) {
  absl::Status status(code, detail.where + ": " + detail.message + "; " + detail.hint);
  std::string payload = detail.reason + kSeparator + detail.where + kSeparator + detail.message +
                        kSeparator + detail.hint;
  status.SetPayload(kPayloadType, absl::Cord(payload));
  return status;
}

std::optional<ErrorDetail> GetErrorDetail(const absl::Status& status) {
  absl::optional<absl::Cord> payload = status.GetPayload(kPayloadType);
  if (!payload.has_value()) return std::nullopt;
  std::string text(*payload);
  ErrorDetail detail;
  std::string* fields[] = {&detail.reason, &detail.where, &detail.message, &detail.hint};
  size_t begin = 0;
  for (std::string* field : fields) {
    size_t end = std::min(text.find(kSeparator, begin), text.size());
    *field = text.substr(begin, end - begin);
    begin = std::min(end + 1, text.size());
  }
  return detail;
}

std::string ReasonOf(const absl::Status& status) {
  const std::optional<ErrorDetail> detail = GetErrorDetail(status);
  return detail.has_value() ? detail->reason : "";
}

absl::Status SceneError(const std::string& where, const std::string& message,
                        const std::string& hint) {
  return MakeError(absl::StatusCode::kInvalidArgument, {"SCENE_INVALID", where, message, hint});
}

}  // namespace lambert
