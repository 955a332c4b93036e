// lambert-merger: a merge shard of a lambert-server, as a program.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <memory>
#include <random>
#include <string>

#include "absl/strings/str_format.h"
#include "absl/synchronization/mutex.h"
#include "net/channel.h"
#include "net/follow_server.h"
#include "server/door_options.h"
#include "server/merge/merge_shard.h"
#include "server/merge/merger_text.h"
#include "server/merge/shard_session.h"
#include "server/rpc/rpc_server.h"
#include "server/rpc/services.h"
#include "telemetry/http_server.h"
#include "telemetry/options.h"

namespace lambert::server {
namespace {

// For the steps that are under way.
constexpr absl::Duration kDrainGrace = absl::Seconds(3);

struct Options {
  std::string listen = "127.0.0.1:0", advertise;
  std::string server, server_file;
  DoorOptions doors;
  CredentialFiles credentials;
  std::string http;
  Log log;
};

int Fail(const absl::Status& status) {
  std::fprintf(stderr, "error: %s\n", std::string(status.message()).c_str());
  return 1;
}

// No two runs of programs have the same.
std::string NewName() {
  std::random_device random;
  return absl::StrFormat("%08x%08x%08x%08x", random(), random(), random(), random());
}

// Workers are told this address: the one that is listened on, or another host's name for it.
std::string Advertised(const Options& options, const std::string& listening) {
  if (options.advertise.empty()) return listening;
  return options.advertise + listening.substr(listening.rfind(':'));
}

int Run(const Options& options, const sigset_t& signals) {
  MergeShard shard;
  const std::string name = NewName();
  const auto make = [&](const Doors* doors) {
    std::vector<std::unique_ptr<grpc::Service>> services;
    services.push_back(MakePartService(&shard, name, doors));
    return services;
  };
  absl::StatusOr<std::unique_ptr<RpcServer>> server = RpcServer::Start(
      make, [] {}, options.listen, options.doors);
  if (!server.ok()) return Fail(server.status());
  options.log("listening on " + (*server)->address());
  std::unique_ptr<HttpServer> http;
  if (!options.http.empty()) {
    auto started = HttpServer::Start(
        options.http,
        {[&] { return MergerText(shard); }, [&] { return shard.counters().in_session.load(); }});
    if (!started.ok()) return Fail(started.status());
    http = *std::move(started);
    options.log("metrics on http://" + http->address());
  }

  absl::Mutex mutex;
  absl::Status refused;
  const auto refuse = [&](const absl::Status& status) {
    absl::MutexLock lock(&mutex);
    refused = status;
    kill(getpid(), SIGTERM);  // wakes FollowServer
  };
  std::unique_ptr<ShardSession> session;
  FollowServer(options.server, options.server_file, signals, [&](const std::string& address) {
    options.log("the server is at " + address);
    session.reset();
    const auto channel = ConnectToServer(address, options.credentials);
    if (!channel.ok()) return refuse(channel.status());
    session = std::make_unique<ShardSession>(
        *channel, &shard,
        ShardSessionOptions{name, Advertised(options, (*server)->address()), options.log, refuse});
  });
  options.log("waiting for the steps under way; a second signal ends this at once");
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
  if (session != nullptr) session->Drain(kDrainGrace);
  session.reset();
  absl::MutexLock lock(&mutex);
  return refused.ok() ? 0 : Fail(refused);
}

}  // namespace
}  // namespace lambert::server

int main(int argc, char** argv) {
  CLI::App app("lambert-merger: adds up results for a lambert-server, for a range of the patches");
  lambert::server::Options options;
  auto* where = app.add_option_group("server", "where the lambert-server is");
  where->require_option(1);
  where->add_option("--server", options.server, "HOST:PORT of the lambert-server");
  where->add_option(
      "--server-file", options.server_file,
      "file that holds it (lambert-server --address-file); it may come later, and change");
  app.add_option("--listen", options.listen, "HOST:PORT for workers; port 0 for any")
      ->capture_default_str();
  app.add_option("--advertise", options.advertise,
                 "host that workers reach it at, where that is not the one of --listen");
  lambert::server::AddDoorOptions(app, options.doors);
  for (const lambert::CredentialOption& option : lambert::CredentialOptions()) {
    // A certificate is one for both: for workers, and for the server.
    if (app.get_option_no_throw(std::string("--") + option.name) != nullptr) continue;
    app.add_option(std::string("--") + option.name, options.credentials.*option.file, option.help)
        ->envname(option.variable);
  }
  lambert::TelemetryOptions telemetry;
  lambert::AddTelemetryOptions(app, telemetry);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (!options.credentials.tls_ca.empty()) {
    options.credentials.tls_cert = options.doors.tls_cert;
    options.credentials.tls_key = options.doors.tls_key;
  }
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  options.log = lambert::StartLog("lambert-merger", telemetry.log_format);
  options.http = telemetry.http;
  options.doors.log = [log = options.log](const std::string& line) { log(line); };
  return lambert::server::Run(options, signals);
}
