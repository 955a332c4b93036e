// farm_bench WORKERS WATCHERS RAYS ROUNDS [SQUARES]: what one coordinator does for many workers. A
// lambert-server on this machine, WORKERS workers of one slot that shoot no rays, WATCHERS watchers
// that read nothing and kReaders that read everything; jobs of RAYS rays on 32 SQUARES^2 patches. A
// line a round: units a second, the coordinator's processor time a unit, the time from a snapshot
// to its readers, and by how much the coordinator's memory has grown since it was idle.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <sstream>
#include <thread>

#include "absl/time/clock.h"
#include "google/protobuf/util/time_util.h"
#include "tests/distributed/crowd.h"

namespace lambert {
namespace {

constexpr int kReaders = 10;

// Of user and system, of a whole process.
double CpuSeconds(pid_t process) {
  std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
  std::string line;
  std::getline(stat, line);
  std::istringstream fields(line.substr(line.rfind(')') + 2));
  std::string skipped;
  for (int i = 0; i < 11; ++i) fields >> skipped;
  double user = 0, system = 0;
  fields >> user >> system;
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

int64_t FinishedUnits(Farm& farm) {
  int64_t units = 0;
  std::string page;
  do {
    grpc::ClientContext context;
    v1::ListWorkersRequest request;
    request.set_page_token(page);
    v1::ListWorkersResponse response;
    v1::FarmService::NewStub(farm.channel())->ListWorkers(&context, request, &response);
    for (const v1::Worker& worker : response.workers()) units += worker.finished_unit_count();
    page = response.next_page_token();
  } while (!page.empty());
  return units;
}

// Reads a job to its end and notes how old each snapshot is when it arrives [ms].
class Reader {
 public:
  Reader(const std::string& address, const std::string& job, std::mutex* mutex,
         std::vector<double>* ages_ms)
      : thread_([=] {
          auto stub = v1::SnapshotService::NewStub(OwnConnection(address));
          grpc::ClientContext context;
          v1::WatchSnapshotsRequest request;
          request.set_parent(job);
          auto stream = stub->WatchSnapshots(&context, request);
          v1::WatchSnapshotsResponse news;
          while (stream->Read(&news)) {
            if (!news.has_snapshot()) continue;
            const int64_t now = absl::ToUnixMicros(absl::Now());
            const auto made = google::protobuf::util::TimeUtil::TimestampToMicroseconds(
                news.snapshot().create_time());
            const std::lock_guard lock(*mutex);
            ages_ms->push_back(static_cast<double>(now - made) * 1e-3);
          }
        }) {}
  ~Reader() { thread_.join(); }

 private:
  std::thread thread_;
};

double Quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<size_t>(share * static_cast<double>(values.size() - 1))];
}

int Main(int argc, char** argv) {
  if (argc < 5) {
    std::fprintf(stderr, "usage: farm_bench WORKERS WATCHERS RAYS ROUNDS [SQUARES]\n");
    return 2;
  }
  const int worker_count = std::atoi(argv[1]), watcher_count = std::atoi(argv[2]);
  const auto rays = static_cast<int64_t>(std::atof(argv[3]));
  const int rounds = std::atoi(argv[4]), squares = argc > 5 ? std::atoi(argv[5]) : 10;
  Farm farm;
  const StubWorkers workers(farm.address(), worker_count);
  farm.Watch(farm.CreateJob(rays / 10, "", squares, "pmcr").name());  // warms up
  const pid_t server = farm.server().id();
  const int64_t idle_kib = StatusKiB(server, "VmRSS");
  std::mutex mutex;
  std::vector<double> ages_ms;
  for (int round = 0; round < rounds; ++round) {
    const double cpu = CpuSeconds(server);
    const int64_t units = FinishedUnits(farm);
    const auto start = std::chrono::steady_clock::now();
    {
      const std::string job = farm.CreateJob(rays, "", squares, "pmcr").name();
      const IdleWatchers idle(farm.address(), job, watcher_count);
      std::vector<std::unique_ptr<Reader>> readers;
      for (int i = 0; i < kReaders; ++i) {
        readers.push_back(std::make_unique<Reader>(farm.address(), job, &mutex, &ages_ms));
      }
      farm.Watch(job);
    }
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    const auto done = static_cast<double>(FinishedUnits(farm) - units);
    std::printf(
        "%d workers: %.0f units in %.2f s, %.0f units/s, coordinator %.0f us of processor a unit; "
        "snapshots so far %zu: median %.1f ms, p99 %.1f ms; memory +%.1f MiB\n",
        worker_count, done, took.count(), done / took.count(),
        1e6 * (CpuSeconds(server) - cpu) / done, ages_ms.size(), Quantile(ages_ms, 0.5),
        Quantile(ages_ms, 0.99), static_cast<double>(StatusKiB(server, "VmHWM") - idle_kib) / 1024);
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace lambert

int main(int argc, char** argv) { return lambert::Main(argc, argv); }
