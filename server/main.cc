// lambert-server: the coordinator as a program.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <map>
#include <memory>
#include <string>

#include "server/base/files.h"
#include "server/coordinator.h"
#include "server/database/open_stores.h"
#include "server/door_options.h"
#include "server/metrics_text.h"
#include "server/rpc/rpc_server.h"
#include "telemetry/http_server.h"
#include "telemetry/options.h"

namespace lambert::server {
namespace {

constexpr timespec kStandbyPause = {.tv_sec = 0, .tv_nsec = 200'000'000};

// Where the program is reached, and where it keeps what it has.
struct Places {
  std::string listen = "127.0.0.1:7400";
  std::string address_file, http;
  StoreOptions stores;
  DoorOptions doors;
};

int Fail(const absl::Status& status) {
  std::fprintf(stderr, "error: %s\n", std::string(status.message()).c_str());
  return 1;
}
// For results of the units that workers have: those take about half a second each.
constexpr auto kDrainGrace = std::chrono::seconds(3);

absl::StatusOr<std::unique_ptr<Coordinator>> StartCoordinator(const CoordinatorOptions& options,
                                                              const StoreOptions& store_options) {
  if (store_options.data_folder.empty() && store_options.database.empty()) {
    return Coordinator::Start(options);
  }
  absl::StatusOr<Stores> stores = OpenStores(store_options);
  if (!stores.ok()) return stores.status();
  return Coordinator::Start(options, *std::move(stores));
}

int Run(CoordinatorOptions options, Places places, const sigset_t& signals) {
  std::atomic<bool> lost{false};
  options.on_stores_lost = [&](const absl::Status& status) {
    Fail(status);
    lost = true;
    kill(getpid(), SIGTERM);
  };
  places.stores.wait = [&, told = false]() mutable {
    if (!told) options.log("another server owns the database; standing by");
    told = true;
    return sigtimedwait(&signals, nullptr, &kStandbyPause) < 0;
  };
  // Before the coordinator, so that a server that stands by is healthy, if not ready.
  std::unique_ptr<Coordinator> coordinator;
  std::atomic<bool> serving{false};
  absl::StatusOr<std::unique_ptr<HttpServer>> telemetry = nullptr;
  if (!places.http.empty()) {
    telemetry = HttpServer::Start(
        places.http, {[&] { return serving ? MetricsText(*coordinator) : std::string(); },
                      [&] { return serving && !coordinator->is_shutting_down(); }});
    if (!telemetry.ok()) return Fail(telemetry.status());
    options.log("metrics on http://" + (*telemetry)->address());
  }
  absl::StatusOr<std::unique_ptr<Coordinator>> started = StartCoordinator(options, places.stores);
  if (absl::IsCancelled(started.status())) return 0;  // stopped while it stood by
  if (!started.ok()) return Fail(started.status());
  coordinator = *std::move(started);
  absl::StatusOr<std::unique_ptr<RpcServer>> server =
      RpcServer::Start(coordinator.get(), places.listen, places.doors);
  if (!server.ok()) return Fail(server.status());
  if (!places.address_file.empty()) {
    const absl::Status told = WriteFileAtomically(places.address_file, (*server)->address() + "\n");
    if (!told.ok()) return Fail(told);
  }
  options.log("listening on " + (*server)->address());
  serving = true;
  int signal = 0;
  sigwait(&signals, &signal);
  options.log(lost ? "stopping" : "stopping; a second signal ends this at once");
  if (lost) return 1;
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
  coordinator->Drain(kDrainGrace);
  return 0;
}

}  // namespace
}  // namespace lambert::server

int main(int argc, char** argv) {
  CLI::App app("lambert-server: takes scenes from clients and has workers solve them");
  lambert::server::Places places;
  lambert::server::CoordinatorOptions options;
  app.add_option("--listen", places.listen, "HOST:PORT; port 0 for any")->capture_default_str();
  app.add_option("--address-file", places.address_file,
                 "file to write HOST:PORT to once it listens (lambert-worker --server-file)");
  app.add_option("--data", places.stores.data_folder,
                 "folder for scenes, jobs and checkpoints; without it all is kept in memory");
  app.add_option(
      "--database", places.stores.database,
      "postgresql://...: records there, and not in DIR/lambert.db; of several servers on one "
      "database and folder one works, and the others stand by");
  app.add_option("--jobs", options.max_running_jobs, "jobs that are solved at once")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  using lambert::server::JournalMode;
  app.add_option(
         "--journal", options.journal,
         "auto|every|off: steps that are kept, so that a server that is started again goes on "
         "after them; auto: those that took 20 times longer than keeping them")
      ->transform(
          CLI::CheckedTransformer(std::map<std::string, JournalMode>{{"auto", JournalMode::kAuto},
                                                                     {"every", JournalMode::kEvery},
                                                                     {"off", JournalMode::kOff}}));
  app.add_option("--shard-patches", options.work.least_shard_patches,
                 "a merge shard takes at least so many patches, and jobs of fewer need none")
      ->check(CLI::Range(1, 1 << 30))
      ->capture_default_str();
  lambert::server::AddLimitOptions(app, options);
  lambert::server::NewToken new_token;
  lambert::server::AddNewTokenOptions(app, lambert::server::AddDoorOptions(app, places.doors),
                                      new_token);
  lambert::TelemetryOptions telemetry;
  lambert::AddTelemetryOptions(app, telemetry);
  double worker_timeout_s = lambert::server::ToSeconds(options.work.session_expiry);
  app.add_option("--worker-timeout", worker_timeout_s,
                 "seconds of a worker's silence after which its units go to others")
      ->check(CLI::Range(0.5, 3600.0))
      ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (!new_token.name.empty()) {
    const absl::Status printed = lambert::server::PrintNewToken(places.doors.tokens, new_token);
    return printed.ok() ? 0 : lambert::server::Fail(printed);
  }
  options.work.SetSessionExpiry(std::chrono::duration<double>(worker_timeout_s));
  // Before any thread starts, so that every thread inherits the mask and sigwait gets them.
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is a full store, not the end
  options.log = options.work.log = lambert::StartLog("lambert-server", telemetry.log_format);
  places.doors.log = [log = options.log](const std::string& line) { log(line); };
  places.http = telemetry.http;
  return lambert::server::Run(options, places, signals);
}
