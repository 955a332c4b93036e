#include "app/exit.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <string>

#include "nlohmann/json.hpp"
#include "radiosity/core/error.h"

namespace lambert::app {
namespace {

// Errors of libraries carry no detail: the code's name stands for the reason.
ErrorDetail DetailOf(const absl::Status& status) {
  if (auto detail = GetErrorDetail(status)) return *detail;
  return {absl::StatusCodeToString(status.code()), "lambert", std::string(status.message()),
          "run the command again, and report this if it stays"};
}

std::string OneLine(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

}  // namespace

ExitCode ExitCodeFor(const absl::Status& status) {
  static const auto& reasons = *new std::map<std::string, ExitCode>{
      {"USAGE", ExitCode::kUsage},
      {"FIELD_INVALID", ExitCode::kUsage},
      {"SCENE_FILE_MISSING", ExitCode::kBadScene},
      {"SCENE_INVALID", ExitCode::kBadScene},
      {"SCENE_TOO_LARGE", ExitCode::kBadScene},
      {"EXTENSION_UNSUPPORTED", ExitCode::kBadScene},
      {"NO_TRIANGLES", ExitCode::kBadScene},
      {"SERVER_UNREACHABLE", ExitCode::kNoServer},
      {"INTERRUPTED", ExitCode::kInterrupted},
  };
  if (status.ok()) return ExitCode::kDone;
  auto found = reasons.find(DetailOf(status).reason);
  return found == reasons.end() ? ExitCode::kFailed : found->second;
}

ExitCode ReportError(const absl::Status& status, bool json) {
  const ErrorDetail detail = DetailOf(status);
  const std::string line = detail.where + ": " + detail.message + "; " + detail.hint;
  std::fprintf(stderr, "error: %s\n", OneLine(line).c_str());
  if (json) {
    const nlohmann::ordered_json error = {{"error",
                                           {{"reason", detail.reason},
                                            {"where", detail.where},
                                            {"message", detail.message},
                                            {"hint", detail.hint}}}};
    // Bytes of a hostile file may come along in a message: replaced where they are not UTF-8.
    const auto text = error.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    std::printf("%s\n", text.c_str());
  }
  return ExitCodeFor(status);
}

absl::Status UsageError(const std::string& where, const std::string& message,
                        const std::string& hint) {
  return MakeError(absl::StatusCode::kInvalidArgument, {"USAGE", where, message, hint});
}

}  // namespace lambert::app
