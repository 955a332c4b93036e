// lambert-server: the coordinator as a program.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <memory>
#include <string>

#include "server/coordinator.h"
#include "server/rpc/rpc_server.h"

namespace lambert::server {
namespace {

int Run(const CoordinatorOptions& options, const std::string& listen, const sigset_t& signals) {
  absl::StatusOr<std::unique_ptr<Coordinator>> coordinator = Coordinator::Start(options);
  if (!coordinator.ok()) {
    std::fprintf(stderr, "error: %s\n", std::string(coordinator.status().message()).c_str());
    return 1;
  }
  absl::StatusOr<std::unique_ptr<RpcServer>> server = RpcServer::Start(coordinator->get(), listen);
  if (!server.ok()) {
    std::fprintf(stderr, "error: %s\n", std::string(server.status().message()).c_str());
    return 1;
  }
  std::fprintf(stderr, "listening on %s\n", (*server)->address().c_str());
  int signal = 0;
  sigwait(&signals, &signal);
  options.log("stopping");
  return 0;
}

}  // namespace
}  // namespace lambert::server

int main(int argc, char** argv) {
  CLI::App app("lambert-server: takes scenes from clients and has workers solve them");
  std::string listen = "127.0.0.1:7400";
  lambert::server::CoordinatorOptions options;
  app.add_option("--listen", listen, "HOST:PORT; port 0 for any")->capture_default_str();
  app.add_option("--data", options.data_folder,
                 "folder for scenes, jobs and checkpoints; without it all is kept in memory");
  app.add_option("--jobs", options.max_running_jobs, "jobs that are solved at once")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  // Before any thread starts, so that every thread inherits the mask and sigwait gets them.
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is a full store, not the end
  spdlog::set_default_logger(spdlog::stderr_color_mt("lambert-server"));
  options.log = [](const std::string& line) { spdlog::info("{}", line); };
  return lambert::server::Run(options, listen, signals);
}
