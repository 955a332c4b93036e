#include "telemetry/log.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include "nlohmann/json.hpp"

namespace lambert {
namespace {

using Json = nlohmann::ordered_json;

Json ToJson(const LogLine& line) {
  Json json = {{"text", line.text}};
  if (!line.about.job.empty()) json["job"] = line.about.job;
  if (line.about.step >= 0) json["step"] = line.about.step;
  if (line.about.unit >= 0) json["unit"] = line.about.unit;
  if (!line.about.worker.empty()) json["worker"] = line.about.worker;
  return json;
}

std::string Dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string TextOf(const LogLine& line) {
  const Json json = ToJson(line);
  std::string text = line.text;
  for (const auto& [key, value] : json.items()) {
    if (key == "text") continue;
    text += " " + key + "=" + (value.is_string() ? value.get<std::string>() : Dump(value));
  }
  return text;
}

std::string JsonMembersOf(const LogLine& line) {
  const std::string object = Dump(ToJson(line));
  return object.substr(1, object.size() - 2);
}

Log StartLog(const std::string& program, LogFormat format) {
  auto logger = spdlog::stderr_color_mt(program);
  if (format == LogFormat::kJson) {
    logger->set_pattern(R"({"time":"%Y-%m-%dT%H:%M:%S.%e%z","level":"%l","program":"%n",%v})");
  }
  spdlog::set_default_logger(logger);
  return [logger, format](const LogLine& line) {
    logger->info("{}", format == LogFormat::kJson ? JsonMembersOf(line) : TextOf(line));
  };
}

}  // namespace lambert
