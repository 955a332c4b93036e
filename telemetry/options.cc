#include "telemetry/options.h"

#include <map>

namespace lambert {

void AddTelemetryOptions(CLI::App& app, TelemetryOptions& options) {
  app.add_option("--http", options.http,
                 "HOST:PORT for /metrics, /healthz and /readyz; port 0 for any; without it none");
  AddLogOption(app, options.log_format);
}

void AddLogOption(CLI::App& app, LogFormat& format) {
  const std::map<std::string, LogFormat> formats = {{"text", LogFormat::kText},
                                                    {"json", LogFormat::kJson}};
  app.add_option("--log-format", format, "text or json")
      ->transform(CLI::CheckedTransformer(formats).description(""))
      ->default_str("text");
}

}  // namespace lambert
