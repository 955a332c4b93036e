// lambert-worker: a worker as a program.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <memory>
#include <string>

#include "absl/synchronization/mutex.h"
#include "net/follow_server.h"
#include "telemetry/http_server.h"
#include "telemetry/options.h"
#include "worker/metrics_text.h"
#include "worker/worker.h"

namespace {

// HOST-PID: no two workers of a farm have the same.
std::string DefaultName() {
  char host[65] = "";
  gethostname(host, sizeof(host) - 1);
  return std::string(host) + "-" + std::to_string(getpid());
}

// Before any thread starts, so that every thread inherits the mask and sigwait gets the signals.
sigset_t BlockSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

// Works until a signal comes.
void Work(const std::string& server, const std::string& server_file,
          const lambert::CredentialFiles& credentials, lambert::worker::WorkerOptions options,
          const sigset_t& signals) {
  options.connect = [&credentials](const std::string& address) {
    return lambert::ConnectToServer(address, credentials);
  };
  std::unique_ptr<lambert::worker::Worker> worker;
  lambert::FollowServer(server, server_file, signals, [&](const std::string& address) {
    options.log("the server is at " + address);
    worker.reset();  // two at once would take one another's place
    const auto channel = options.connect(address);
    if (!channel.ok()) return options.on_refused(channel.status());
    worker = std::make_unique<lambert::worker::Worker>(*channel, options);
  });
  options.log("finishing what runs; a second signal ends this at once");
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("lambert-worker: computes units of work for a lambert-server");
  std::string server, server_file;
  lambert::worker::WorkerOptions options;
  options.worker_id = DefaultName();
  auto* where = app.add_option_group("server", "where the lambert-server is");
  where->require_option(1);
  where->add_option("--server", server, "HOST:PORT of the lambert-server");
  where->add_option(
      "--server-file", server_file,
      "file that holds it (lambert-server --address-file); it may come later, and change");
  app.add_option("--slots", options.slots, "units that run at once, one thread each")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  app.add_option("--name", options.worker_id, "unique among the server's workers")
      ->capture_default_str();
  lambert::CredentialFiles credentials;
  for (const lambert::CredentialOption& option : lambert::CredentialOptions()) {
    app.add_option(std::string("--") + option.name, credentials.*option.file, option.help)
        ->envname(option.variable);
  }
  lambert::TelemetryOptions telemetry;
  lambert::AddTelemetryOptions(app, telemetry);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  const sigset_t signals = BlockSignals();
  std::signal(SIGPIPE, SIG_IGN);
  options.log = [log = lambert::StartLog("lambert-worker", telemetry.log_format),
                 name = options.worker_id](lambert::LogLine line) {
    line.about.worker = name;
    log(line);
  };
  std::unique_ptr<lambert::HttpServer> http;
  if (!telemetry.http.empty()) {
    auto started = lambert::HttpServer::Start(
        telemetry.http,
        {[&] { return lambert::worker::MetricsText(*options.counters, options.slots); },
         [&] { return options.counters->in_session.load(); }});
    if (!started.ok()) {
      std::fprintf(stderr, "error: %s\n", std::string(started.status().message()).c_str());
      return 1;
    }
    http = *std::move(started);
    options.log("metrics on http://" + http->address());
  }

  absl::Mutex mutex;
  absl::Status refused;
  options.on_refused = [&](const absl::Status& status) {
    absl::MutexLock lock(&mutex);
    refused = status;
    kill(getpid(), SIGTERM);  // wakes Work
  };
  Work(server, server_file, credentials, options, signals);
  absl::MutexLock lock(&mutex);
  if (refused.ok()) return 0;
  std::fprintf(stderr, "error: %s\n", std::string(refused.message()).c_str());
  return 1;
}
