#include "worker/metrics_text.h"

#include "telemetry/metric_page.h"

namespace lambert::worker {

std::string MetricsText(const WorkerCounters& counters, int slots) {
  MetricPage page;
  page.Gauge("lambert_worker_in_session", "1 while the server knows this worker.",
             counters.in_session ? 1 : 0);
  page.Gauge("lambert_worker_slots", "Units that it runs at once.", slots);
  page.Gauge("lambert_worker_running", "Units that it runs now.",
             static_cast<double>(counters.running));
  const char* units = "Units that it ran, by how they ended.";
  page.Counter("lambert_worker_units_total", units, static_cast<double>(counters.units_done),
               {{"outcome", "done"}});
  page.Counter("lambert_worker_units_total", units, static_cast<double>(counters.units_failed),
               {{"outcome", "failed"}});
  page.Counter("lambert_worker_rays_total", "Rays of units that are done.",
               static_cast<double>(counters.rays));
  page.Counter("lambert_worker_run_seconds_total", "Time that slots spent on them.",
               static_cast<double>(counters.run_microseconds) * 1e-6);
  page.Counter("lambert_worker_result_bytes_total", "Bytes of results that were sent.",
               static_cast<double>(counters.result_bytes));
  page.Counter("lambert_worker_patch_bytes_total", "Bytes of patch sets that were fetched.",
               static_cast<double>(counters.patch_bytes));
  return page.Text();
}

}  // namespace lambert::worker
