// A farm of real programs on this machine: one lambert-server, any number of lambert-workers.
#pragma once

#include <grpcpp/grpcpp.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "lambert/v1/farm_service.grpc.pb.h"
#include "tests/service/service_calls.h"
#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace lambert {

class Farm : public ServiceCalls {
 public:
  // `max_file_bytes`: no file of the server may grow larger; 0: no limit. `environment`: of the
  // first server only.
  explicit Farm(std::vector<std::string> server_arguments = {}, int64_t max_file_bytes = 0,
                const ProcessOptions& environment = {})
      : server_arguments_(std::move(server_arguments)), max_file_bytes_(max_file_bytes) {
    StartServer("127.0.0.1:0", environment);
  }

  void AddWorker(int slots = 1) {
    workers_.push_back(std::make_unique<Process>(std::vector<std::string>{
        LAMBERT_WORKER, "--server", address_, "--slots", std::to_string(slots), "--name",
        "worker-" + std::to_string(workers_.size())}));
  }
  // A worker whose address space may grow by so much once it is idle.
  void AddWorkerWithoutMemory(int64_t spare_bytes) {
    AddWorker();
    Process& worker = *workers_.back();
    worker.WaitForError("at work");
    std::ifstream statm("/proc/" + std::to_string(worker.id()) + "/statm");
    int64_t pages = 0;
    statm >> pages;
    const auto bytes = static_cast<rlim_t>(pages * getpagesize() + spare_bytes);
    const rlimit limit{bytes, bytes};
    EXPECT_EQ(prlimit(worker.id(), RLIMIT_AS, &limit, nullptr), 0);
  }
  Process& worker(int i) { return *workers_[i]; }
  Process& server() { return *server_; }
  const std::string& address() const { return address_; }

  // As a crash of the machine does; the address stays.
  void KillAndRestartServer() {
    server_->Signal(SIGKILL);
    RestartServer();
  }
  // Waits for the server's end and starts another in its place. Returns the first one's exit code.
  int RestartServer() {
    const int code = server_->Wait();
    StartServer(address_, {});
    return code;
  }
  // As on a disk that is full from now on: no file of the server may grow any more.
  void FillDisk() {
    const rlimit nothing = {0, RLIM_INFINITY};
    prlimit(server_->id(), RLIMIT_FSIZE, &nothing, nullptr);
  }
  // The worker as the server lists it; nothing where it has no session.
  std::optional<v1::Worker> Listed(int worker) {
    grpc::ClientContext context;
    v1::ListWorkersResponse response;
    v1::FarmService::NewStub(channel())->ListWorkers(&context, {}, &response);
    for (const v1::Worker& listed : response.workers()) {
      if (listed.name() == "workers/worker-" + std::to_string(worker)) return listed;
    }
    return std::nullopt;
  }
  // Blocks until the worker has a unit: a step is in its middle. False where the job ends before.
  bool WaitUntilItHasAUnit(int worker, const std::string& job) {
    return WaitUntil(job, [&] {
      const std::optional<v1::Worker> listed = Listed(worker);
      return listed.has_value() && listed->lease_count() > 0;
    });
  }
  // Blocks until the worker has lost its session, or has one. False where the job ends before.
  bool WaitUntilListed(int worker, bool listed, const std::string& job) {
    return WaitUntil(job, [&] { return Listed(worker).has_value() == listed; });
  }
  // Blocks until workers have finished units of the job: it is in the middle.
  void WaitUntilUnderWay(const std::string& job, int passes = 0) {
    grpc::ClientContext context;
    v1::WatchSnapshotsRequest request;
    request.set_parent(job);
    auto reader = snapshots()->WatchSnapshots(&context, request);
    v1::WatchSnapshotsResponse news;
    while (reader->Read(&news)) {
      if (news.progress().ray_count() > 0 && news.progress().pass() >= passes) break;
    }
    context.TryCancel();
  }

 private:
  bool WaitUntil(const std::string& job, const std::function<bool()>& holds) {
    while (!holds()) {
      grpc::ClientContext context;
      v1::GetSolveJobRequest request;
      request.set_name(job);
      v1::SolveJob found;
      if (!jobs()->GetSolveJob(&context, request, &found).ok() || found.has_end_time()) {
        return false;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return true;
  }
  void StartServer(const std::string& listen, const ProcessOptions& environment) {
    std::vector<std::string> command = {LAMBERT_SERVER, "--listen", listen};
    command.insert(command.end(), server_arguments_.begin(), server_arguments_.end());
    if (max_file_bytes_ > 0) {
      const std::string limit = "--fsize=" + std::to_string(max_file_bytes_);
      command.insert(command.begin(), {"/usr/bin/prlimit", limit});
    }
    server_ = std::make_unique<Process>(command, environment);
    const std::string announcement = "listening on ";
    const size_t begin = server_->WaitForError(announcement);
    const size_t end = server_->WaitForError("\n", begin);
    address_ = server_->error().substr(begin, end - 1 - begin);
    Connect(grpc::CreateChannel(address_, grpc::InsecureChannelCredentials()));
  }

  const std::vector<std::string> server_arguments_;
  const int64_t max_file_bytes_;
  std::string address_;
  std::unique_ptr<Process> server_;
  std::vector<std::unique_ptr<Process>> workers_;
};

}  // namespace lambert
