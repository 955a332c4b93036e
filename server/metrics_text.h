// The metrics of a coordinator, as /metrics shows them; docs/metrics.md lists them.
#pragma once

#include <string>

namespace lambert::server {

class Coordinator;

std::string MetricsText(Coordinator& coordinator);

}  // namespace lambert::server
