// What the programs show of themselves adds up.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

#include "tests/distributed/farm.h"
#include "tests/support/http_get.h"

namespace lambert {
namespace {

// The address behind `words` in what a program said.
std::string Announced(Process& process, const std::string& words) {
  const size_t begin = process.WaitForError(words);
  const size_t end = process.error().find_first_of("\" \n", process.WaitForError(":", begin));
  return process.error().substr(begin, end - begin);
}

// The value of a metric, with its labels; -1 where the page has none.
double Value(const std::string& page, const std::string& metric) {
  const size_t at = page.find("\n" + metric + " ");
  return at == std::string::npos ? -1 : std::stod(page.substr(at + metric.size() + 2));
}

std::set<std::string> Names(const std::string& page) {
  std::set<std::string> names;
  std::istringstream lines(page);
  for (std::string line, name; std::getline(lines, line);) {
    const std::string head = "# TYPE ";
    if (line.rfind(head, 0) == 0) {
      names.insert(line.substr(head.size(), line.find(' ', head.size()) - head.size()));
    }
  }
  return names;
}

TEST(Metrics, OfServerAndWorkerAddUp) {
  Farm farm({"--http", "127.0.0.1:0", "--shard-patches", "1"});
  Process merger({LAMBERT_MERGER, "--server", farm.address(), "--http", "127.0.0.1:0"});
  merger.WaitForError("at work as merge shard");
  Process worker({LAMBERT_WORKER, "--server", farm.address(), "--http", "127.0.0.1:0", "--name",
                  "w", "--log-format", "json"});
  const std::string server_page = Announced(farm.server(), "metrics on http://");
  const std::string merger_page = Announced(merger, "metrics on http://");
  const std::string worker_page = Announced(worker, "metrics on http://");
  const v1::SolveJob job = farm.Watch(farm.CreateJob(100'000).name()).ended;
  ASSERT_EQ(job.state(), v1::SolveJob::STATE_SUCCEEDED);

  const std::string server = HttpGet(server_page, "/metrics");
  EXPECT_EQ(Value(server, "lambert_rays_total"), static_cast<double>(job.progress().ray_count()));
  EXPECT_EQ(Value(server, "lambert_jobs{state=\"succeeded\"}"), 1);
  EXPECT_EQ(Value(server, "lambert_workers"), 1);
  EXPECT_EQ(Value(server, "lambert_slots"), 1);
  EXPECT_EQ(Value(server, "lambert_queue_rays"), 0);
  EXPECT_EQ(Value(server, "lambert_watchers"), 0);
  EXPECT_GT(Value(server, "lambert_run_seconds_total"), 0);
  EXPECT_GT(Value(server, "lambert_merge_seconds_total"), 0);
  EXPECT_GT(Value(server, "lambert_uploaded_bytes_total"), 0);

  const std::string mine = HttpGet(worker_page, "/metrics");
  EXPECT_EQ(Value(mine, "lambert_worker_in_session"), 1);
  EXPECT_EQ(Value(mine, "lambert_worker_units_total{outcome=\"done\"}"),
            Value(server, "lambert_results_total{outcome=\"accepted\"}"));
  EXPECT_EQ(Value(mine, "lambert_worker_rays_total"), Value(server, "lambert_rays_total"));
  const std::string sums = HttpGet(merger_page, "/metrics");
  EXPECT_EQ(
      Value(mine, "lambert_worker_result_bytes_total"),
      Value(server, "lambert_result_bytes_total") + Value(sums, "lambert_merger_part_bytes_total"));
  EXPECT_EQ(Value(sums, "lambert_merger_in_session"), 1);
  EXPECT_EQ(Value(sums, "lambert_merger_parts_total{outcome=\"refused\"}"), 0);
  EXPECT_GT(Value(sums, "lambert_merger_parts_total{outcome=\"accepted\"}"), 0);
  EXPECT_GT(Value(sums, "lambert_merger_sums_total"), 0);
  EXPECT_GT(Value(sums, "lambert_merger_merge_seconds_total"), 0);
  EXPECT_EQ(Value(mine, "lambert_worker_patch_bytes_total"),
            static_cast<double>(job.patch_set_digest().size_bytes()));
  EXPECT_EQ(HttpGet(worker_page, "/readyz").find("HTTP/1.1 200"), 0u);

  // docs/metrics.md lists these and no others.
  std::ifstream file("docs/metrics.md");
  const std::string docs{std::istreambuf_iterator<char>(file), {}};
  std::set<std::string> listed, shown = Names(server);
  for (size_t at = 0; (at = docs.find("\n| `lambert_", at)) != std::string::npos; ++at) {
    listed.insert(docs.substr(at + 4, docs.find_first_of("`{", at + 4) - at - 4));
  }
  shown.merge(Names(mine));
  shown.merge(Names(sums));
  // Of jobs that run, and of those that want an error.
  shown.insert({"lambert_job_rays", "lambert_job_estimated_error", "lambert_job_wanted_error"});
  EXPECT_EQ(listed, shown);
}

TEST(Metrics, OfARunningJobTellItsErrorAndItsWatchers) {
  Farm farm({"--http", "127.0.0.1:0"});
  const std::string page = Announced(farm.server(), "metrics on http://");
  farm.AddWorker();
  const std::string job = farm.CreateJob(int64_t{1} << 50).name();
  farm.WaitUntilUnderWay(job, 3);
  grpc::ClientContext context;
  v1::WatchSnapshotsRequest request;
  request.set_parent(job);
  auto reader = farm.snapshots()->WatchSnapshots(&context, request);
  v1::WatchSnapshotsResponse news;
  ASSERT_TRUE(reader->Read(&news));
  const std::string metrics = HttpGet(page, "/metrics");
  const std::string label = "{job=\"" + job.substr(job.find('/') + 1) + "\"}";
  EXPECT_GT(Value(metrics, "lambert_job_estimated_error" + label), 0) << metrics;
  EXPECT_GT(Value(metrics, "lambert_job_rays" + label), 0);
  EXPECT_GE(Value(metrics, "lambert_watchers"), 1);
  EXPECT_GE(Value(metrics, "lambert_leases_granted_total"), 1);
  context.TryCancel();
}

TEST(Metrics, OfAWorkerWithoutAServerSayThatItIsNotReady) {
  Process worker({LAMBERT_WORKER, "--server", "127.0.0.1:1", "--http", "127.0.0.1:0"});
  const std::string page = Announced(worker, "metrics on http://");
  EXPECT_EQ(HttpGet(page, "/readyz").find("HTTP/1.1 503"), 0u);
  EXPECT_EQ(HttpGet(page, "/healthz").find("HTTP/1.1 200"), 0u);
}

// The server says which unit a lost worker took along.
TEST(Logs, NameJobStepUnitAndWorkerOfALeaseThatFails) {
  Farm farm({"--log-format", "json"});
  farm.AddWorker();
  const std::string job = farm.CreateJob(int64_t{1} << 50).name();
  farm.WaitUntilUnderWay(job);
  farm.worker(0).Signal(SIGKILL);
  const size_t at = farm.server().WaitForError("lease failed: the worker fell silent");
  farm.server().WaitForError("\n", at);
  const std::string rest = farm.server().error().substr(at);
  const std::string line = rest.substr(0, rest.find('\n'));
  EXPECT_NE(line.find("\"job\":\"" + job + "\",\"step\":"), std::string::npos) << line;
  EXPECT_NE(line.find("\"unit\":"), std::string::npos) << line;
  EXPECT_NE(line.find("\"worker\":\"worker-0\"}"), std::string::npos) << line;
}

}  // namespace
}  // namespace lambert
