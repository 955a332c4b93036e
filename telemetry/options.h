// The options of how a program shows what it does, named once for server, worker and merge shard.
#pragma once

#include <string>

#include "CLI/CLI.hpp"
#include "telemetry/log.h"

namespace lambert {

struct TelemetryOptions {
  std::string http;  // HOST:PORT of /metrics, /healthz, /readyz; "": not served
  LogFormat log_format = LogFormat::kText;
};

void AddTelemetryOptions(CLI::App& app, TelemetryOptions& options);  // --http, and the one below
void AddLogOption(CLI::App& app, LogFormat& format);                 // --log-format

}  // namespace lambert
