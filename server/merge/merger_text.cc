#include "server/merge/merger_text.h"

#include "telemetry/metric_page.h"

namespace lambert::server {

std::string MergerText(MergeShard& shard) {
  const MergeCounters& counters = shard.counters();
  MetricPage page;
  page.Gauge("lambert_merger_in_session", "1 while the server knows this merge shard.",
             counters.in_session ? 1 : 0);
  page.Gauge("lambert_merger_steps", "Steps that it takes parts of.", shard.step_count());
  const auto parts = [&](const char* outcome, int64_t count) {
    page.Counter("lambert_merger_parts_total", "Parts of results that arrived.",
                 static_cast<double>(count), {{"outcome", outcome}});
  };
  parts("accepted", counters.parts_accepted);
  parts("duplicate", counters.parts_duplicate);
  parts("split", counters.parts_split);
  parts("refused", counters.parts_refused);
  page.Counter("lambert_merger_part_bytes_total", "Bytes of parts that arrived.",
               static_cast<double>(counters.part_bytes));
  page.Counter("lambert_merger_merge_seconds_total", "Time spent on checking and merging them.",
               static_cast<double>(counters.merge_microseconds) * 1e-6);
  page.Counter("lambert_merger_sums_total", "Sums of steps that were whole.",
               static_cast<double>(counters.sums));
  return page.Text();
}

}  // namespace lambert::server
