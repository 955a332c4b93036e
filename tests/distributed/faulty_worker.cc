// faulty-worker: a lambert-worker that is at fault now and then, for tests of what the coordinator
// makes of it.
#include <CLI/CLI.hpp>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <new>
#include <string>

#include "radiosity/core/error.h"
#include "worker/worker.h"

namespace lambert {
namespace {

struct Fault {
  std::string kind = "ledger";
  int every = 5;  // units
};

// Counts over all shooters: jobs may be shorter than `every`.
std::atomic<int> units{0};

class FaultyShooter : public Shooter {
 public:
  FaultyShooter(std::shared_ptr<const Shooter> honest, const Fault& fault)
      : honest_(std::move(honest)), fault_(fault) {}

  absl::StatusOr<UnitResult> Run(const WorkUnit& unit) const override {
    const bool is_at_fault = (units.fetch_add(1) + 1) % fault_.every == 0;
    if (!is_at_fault) return honest_->Run(unit);
    if (fault_.kind == "memory") throw std::bad_alloc();
    absl::StatusOr<UnitResult> result = honest_->Run(unit);
    if (!result.ok()) return result;
    if (fault_.kind == "ledger") {
      ++result->escaped[0];
    } else {  // "hits": the ledger balances, so only another worker's result tells
      for (Deposit& deposit : result->deposits) deposit.patch ^= 1;
    }
    return result;
  }

 private:
  const std::shared_ptr<const Shooter> honest_;
  const Fault fault_;
};

int Main(int argc, char** argv) {
  CLI::App app("faulty-worker: a lambert-worker that is at fault now and then");
  std::string server;
  Fault fault;
  worker::WorkerOptions options;
  app.add_option("--server", server, "HOST:PORT of the lambert-server")->required();
  app.add_option("--name", options.worker_id, "unique among the server's workers")->required();
  app.add_option("--fault", fault.kind,
                 "ledger: results that do not balance; hits: results that balance and are wrong; "
                 "memory: too little; version: of another program")
      ->check(CLI::IsMember({"ledger", "hits", "memory", "version"}));
  app.add_option("--every", fault.every, "units, of which the last is wrong")
      ->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);

  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  if (fault.kind == "version") options.unit_version = "another";
  options.make_shooter =
      [&fault](std::shared_ptr<const PatchSet> patches,
               const ShootOptions& shoot) -> absl::StatusOr<std::shared_ptr<const Shooter>> {
    auto honest = Shooter::Create(std::move(patches), shoot);
    if (!honest.ok()) return honest.status();
    return std::make_shared<const FaultyShooter>(*std::move(honest), fault);
  };
  options.log = [](const LogLine& line) { std::fprintf(stderr, "%s\n", line.text.c_str()); };
  options.on_refused = [](const absl::Status& status) {
    std::fprintf(stderr, "error: %s\n", std::string(status.message()).c_str());
    std::_Exit(1);
  };
  const worker::Worker worker(*ConnectToServer(server), options);
  int signal = 0;
  sigwait(&signals, &signal);
  return 0;
}

}  // namespace
}  // namespace lambert

int main(int argc, char** argv) { return lambert::Main(argc, argv); }
