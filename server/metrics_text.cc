#include "server/metrics_text.h"

#include <map>
#include <memory>

#include "absl/strings/ascii.h"
#include "server/coordinator.h"
#include "telemetry/metric_page.h"

namespace lambert::server {
namespace {

void AddWork(const WorkTable& work, MetricPage& page) {
  const WorkLoad load = work.Load();
  page.Gauge("lambert_queue_rays", "Rays of published units that nobody holds.",
             static_cast<double>(load.queued_rays));
  page.Gauge("lambert_queue_seconds", "Time that the queue would take one slot.",
             load.queued_seconds);
  page.Gauge("lambert_leases", "Units that workers hold.", load.leases);
  page.Gauge("lambert_workers", "Workers that are connected.", load.workers);
  page.Gauge("lambert_merge_shards", "Merge shards that are connected.",
             work.shards().shard_count());
  page.Gauge("lambert_slots", "Units that workers run at once.", load.slots);

  const WorkCounters& counters = work.counters();
  auto count = [&page](const char* name, const char* help, int64_t value,
                       const MetricPage::Labels& labels = {}) {
    page.Counter(name, help, static_cast<double>(value), labels);
  };
  count("lambert_leases_granted_total", "Leases that were granted.", counters.leases_granted);
  count("lambert_leases_repeated_total", "Of those: of units that had been lent before.",
        counters.leases_repeated);
  count("lambert_lease_failures_total", "Leases that ended by an error or with their worker.",
        counters.leases_failed);
  const char* results = "Results that arrived, by what became of them.";
  count("lambert_results_total", results, counters.results_accepted, {{"outcome", "accepted"}});
  count("lambert_results_total", results, counters.results_duplicate, {{"outcome", "duplicate"}});
  count("lambert_results_total", results, counters.results_obsolete, {{"outcome", "obsolete"}});
  count("lambert_results_total", results, counters.results_refused, {{"outcome", "refused"}});
  count("lambert_result_bytes_total", "Bytes of results that arrived.", counters.result_bytes);
  count("lambert_rays_total", "Rays of accepted results.", counters.rays);
  page.Counter("lambert_run_seconds_total", "Time that slots spent on accepted results.",
               static_cast<double>(counters.run_microseconds) * 1e-6);
  page.Counter("lambert_merge_seconds_total", "Time spent on checking and merging results.",
               static_cast<double>(counters.merge_microseconds) * 1e-6);
}

void AddTraffic(const Traffic& traffic, MetricPage& page) {
  page.Counter("lambert_uploaded_bytes_total", "Bytes of blobs that clients sent.",
               static_cast<double>(traffic.uploaded_bytes));
  page.Counter("lambert_downloaded_bytes_total", "Bytes of blobs that clients and workers fetched.",
               static_cast<double>(traffic.downloaded_bytes));
  page.Gauge("lambert_watchers", "Clients that watch a job.",
             static_cast<double>(traffic.watchers));
}

// "queued" of STATE_QUEUED.
std::string StateName(v1::SolveJob::State state) {
  return absl::AsciiStrToLower(v1::SolveJob::State_Name(state).substr(sizeof("STATE_") - 1));
}

void AddJobs(const JobStore& jobs, MetricPage& page) {
  std::map<v1::SolveJob::State, int> by_state;
  for (int state = v1::SolveJob::STATE_QUEUED; state <= v1::SolveJob::STATE_CANCELLED; ++state) {
    by_state[static_cast<v1::SolveJob::State>(state)] = 0;
  }
  std::map<std::string, v1::Progress> running;
  for (const std::shared_ptr<Job>& job : jobs.All()) {
    const v1::SolveJob record = job->Get();
    ++by_state[record.state()];
    if (record.state() == v1::SolveJob::STATE_RUNNING) running[job->id()] = record.progress();
  }
  for (const auto& [state, count] : by_state) {
    page.Gauge("lambert_jobs", "Jobs that the server knows, by state.", count,
               {{"state", StateName(state)}});
  }
  for (const auto& [job, progress] : running) {
    page.Gauge("lambert_job_rays", "Rays that a running job has shot.",
               static_cast<double>(progress.ray_count()), {{"job", job}});
  }
  for (const auto& [job, progress] : running) {
    if (progress.estimated_rms_area() < 0) continue;  // not known yet
    page.Gauge("lambert_job_estimated_error",
               "Estimated relative area-weighted RMS error of a running job.",
               progress.estimated_rms_area(), {{"job", job}});
  }
  for (const auto& [job, progress] : running) {
    if (progress.wanted_rms_area() <= 0) continue;  // none is wanted
    page.Gauge("lambert_job_wanted_error", "The error at which the job ends.",
               progress.wanted_rms_area(), {{"job", job}});
  }
}

}  // namespace

std::string MetricsText(Coordinator& coordinator) {
  MetricPage page;
  AddJobs(coordinator.jobs(), page);
  AddWork(coordinator.work(), page);
  AddTraffic(coordinator.traffic(), page);
  return page.Text();
}

}  // namespace lambert::server
