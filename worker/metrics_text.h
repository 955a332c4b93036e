// The metrics of a worker, as /metrics shows them; docs/metrics.md lists them.
#pragma once

#include <string>

#include "worker/worker_counters.h"

namespace lambert::worker {

// `slots`: units that the worker runs at once.
std::string MetricsText(const WorkerCounters& counters, int slots);

}  // namespace lambert::worker
