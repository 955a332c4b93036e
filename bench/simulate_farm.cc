// simulate_farm NODES PATCHES [KEY=VALUE...]: one pass on a farm that is not there, as a
// discrete-event simulation with the server's own lease policy (server/work/next_leases.h).
// Prints a line of comma-separated values (--header: their names). docs/scaling.md has the model.
#include <ctime>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <map>
#include <queue>
#include <string>
#include <vector>

#include "bench/farm_constants.h"
#include "radiosity/solve/allocate.h"
#include "server/work/next_leases.h"

namespace lambert::server {
namespace {

TimePoint At(double seconds) {
  return TimePoint() + std::chrono::duration_cast<Duration>(std::chrono::duration<double>(seconds));
}

double ProcessorSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

constexpr double kTick = 0.05;  // seconds: WorkTable::Tick

// Something that serves one after the other: a link, a processor, a lock.
struct Server {
  double free_at = 0, busy = 0;
  double Serve(double now, double time) {
    free_at = std::max(now, free_at) + time;
    busy += time;
    return free_at;
  }
};

class Simulation {
 public:
  Simulation(int nodes, double patches, const Constants& constants)
      : c_(constants),
        patches_(patches),
        processors_(static_cast<size_t>(c_.cores)),
        ledger_processors_(static_cast<size_t>(c_.cores)) {
    options_.units_per_slot = static_cast<int>(c_.units_per_slot);
    options_.max_unit_rays = static_cast<int64_t>(c_.max_unit_rays);
    options_.rays_per_sum = c_.rays_per_sum;
    for (int i = 0; i < nodes; ++i) {
      Node& node = nodes_.emplace_back();
      node.name = "n" + std::to_string(i);
      by_name_[node.name] = i;
      AddSession(state_, node.name, node.name, static_cast<int>(c_.slots), options_);
      SetWaiting(state_, node.name, true);
    }
  }

  void RunPass() {
    events_.push({kTick, Kind::kTick, 0, ""});
    for (double rays = c_.rays_per_patch * patches_ * (1 - c_.reflected); rays >= 1;
         rays *= c_.reflected) {
      const double began = now_, bytes = bytes_;
      RunStep(rays);
      ++steps_;
      rays_ += rays;
      if (c_.by_step > 0) {
        std::printf("%d,%.0f,%.4g,%.3g\n", steps_ - 1, rays, now_ - began, bytes_ - bytes);
      }
    }
  }

  void Print() const {
    if (c_.by_step > 0) return;
    const double ideal = rays_ * c_.ray / (static_cast<double>(nodes_.size()) * c_.slots);
    double processors = 0;
    for (const Server& processor : processors_) processors += processor.busy;
    std::printf("%zu,%.0f,%.0f,%d,%lld,%.4g,%.4g,%.4f,%.4f,%.4f,%.4f,%.4f,%.3g,%.3g\n",
                nodes_.size(), patches_, c_.slots, steps_, static_cast<long long>(units_), now_,
                ideal, ideal / now_, processors / (now_ * static_cast<double>(processors_.size())),
                merging_.busy / now_, link_.busy / now_, table_.busy / now_, bytes_,
                1e6 * policy_seconds_ / static_cast<double>(std::max<int64_t>(policy_calls_, 1)));
  }
  static void PrintHeader() {
    std::puts(
        "nodes,patches,slots,steps,units,seconds,ideal_seconds,efficiency,processors_busy,"
        "merge_busy,link_busy,table_busy,result_bytes,policy_us");
  }

 private:
  struct Node {
    std::string name;
    int running = 0;
    std::deque<std::string> leases;  // that wait for a slot
    std::vector<std::string> ended;  // whose results wait to be sent
    std::vector<std::string> sent;   // on their way, as one result
    Server link;
  };
  enum class Kind { kGranted, kEnded, kArrived, kAsks, kTick };
  struct Event {
    double time;
    Kind kind;
    int node;
    std::string lease;
    bool operator<(const Event& other) const { return time > other.time; }
  };

  // Bytes of the result of so many rays over the patches that they hit: all but those that
  // Poisson's law leaves without a hit, where patches expect gamma-distributed numbers of them.
  double ResultBytes(double rays) const {
    const double missed = std::pow(1 + rays / (patches_ * c_.evenness), -c_.evenness);
    return 200 + c_.deposit_bytes * patches_ * (1 - missed);
  }
  double UnitRays(const std::string& lease) const {
    const UnitRef& unit = state_.leases.at(lease).unit;
    if (state_.leases.at(lease).revoked) return 0;  // somebody else was first
    return static_cast<double>(
        state_.steps.at(unit.job).units[static_cast<size_t>(unit.unit)].rays);
  }

  void RunStep(double rays) {
    const auto whole = static_cast<int64_t>(std::max(1.0, rays));
    const int64_t grain = lambert::UnitRays(whole, static_cast<int64_t>(patches_));
    std::vector<int64_t> grains(static_cast<size_t>(whole / grain), grain);
    if (whole % grain > 0) grains.push_back(whole % grain);
    now_ += c_.step + c_.patch * patches_;
    // As WorkTable::Publish: shards take the steps that have as many rays as patches.
    shards_ = rays >= patches_ ? static_cast<int>(c_.shards) : 0;
    AddStep(state_, "job", ++number_, grains,
            {static_cast<int64_t>(patches_), std::max(shards_, 1)});
    left_ = grains.size();
    Dispatch();
    while (left_ > 0) {
      const Event event = events_.top();
      events_.pop();
      now_ = event.time;
      Handle(event);
    }
    RemoveStep(state_, "job");
    if (shards_ > 0) CollectSums(rays);
  }

  // The shards' sums come over the link of the coordinator, which decodes them beside each other.
  void CollectSums(double rays) {
    const double bytes = ResultBytes(rays);
    now_ += bytes / c_.bandwidth + c_.byte * bytes / std::min<double>(shards_, c_.cores);
  }

  void Handle(const Event& event) {
    Node& node = nodes_[static_cast<size_t>(event.node)];
    switch (event.kind) {
      case Kind::kGranted:
        node.leases.push_back(event.lease);
        Run(event.node);
        return;
      case Kind::kEnded:
        --node.running;
        Run(event.node);
        node.ended.push_back(event.lease);
        Send(event.node);
        return;
      case Kind::kArrived:
        Arrive(event.node);
        return;
      case Kind::kAsks:
        SetWaiting(state_, node.name, true);
        Dispatch();
        return;
      case Kind::kTick:
        Lend(RepeatLate(state_, At(now_), options_));
        events_.push({now_ + kTick, Kind::kTick, 0, ""});
        return;
    }
  }

  void Run(int index) {
    Node& node = nodes_[static_cast<size_t>(index)];
    while (node.running < static_cast<int>(c_.slots) && !node.leases.empty()) {
      const std::string lease = node.leases.front();
      node.leases.pop_front();
      auto found = state_.leases.find(lease);
      if (found == state_.leases.end() || found->second.revoked) {
        RemoveLease(state_, lease, false);
        continue;
      }
      ++node.running;
      events_.push({now_ + c_.ray * UnitRays(lease), Kind::kEnded, index, lease});
    }
  }

  static Server& FirstFree(std::vector<Server>& processors) {
    return *std::min_element(
        processors.begin(), processors.end(),
        [](const Server& a, const Server& b) { return a.free_at < b.free_at; });
  }

  // A node sends one result at a time, of all units that ended meanwhile or of one: over the link,
  // to a processor of the coordinator, to the one who merges. With merge shards a part goes that
  // way to each of them, which are alike, so that one stands for all; then the ledger to the
  // coordinator.
  void Send(int index) {
    Node& node = nodes_[static_cast<size_t>(index)];
    if (!node.sent.empty() || node.ended.empty()) return;
    const bool is_dry = node.running == 0 && node.leases.empty();
    if (c_.combine > 0 && !is_dry && node.ended.size() < static_cast<size_t>(c_.slots)) return;
    const size_t count = c_.combine > 0 ? node.ended.size() : 1;
    const auto end = node.ended.begin() + static_cast<ptrdiff_t>(count);
    node.sent.assign(node.ended.begin(), end);
    node.ended.erase(node.ended.begin(), end);
    double rays = 0;
    for (const std::string& lease : node.sent) rays += UnitRays(lease);
    const double bytes = ResultBytes(rays);
    bytes_ += bytes;
    const double part = bytes / std::max(shards_, 1);
    const double sent = node.link.Serve(now_, bytes / c_.bandwidth);
    const double received = std::max(link_.Serve(now_, part / c_.bandwidth), sent) + c_.latency;
    const double decoded =
        FirstFree(processors_).Serve(received, c_.unit + (c_.byte - c_.merge_byte) * part);
    double merged = merging_.Serve(decoded, c_.merge_byte * part);
    if (shards_ > 0) {
      merged = FirstFree(ledger_processors_).Serve(merged + 2 * c_.latency, c_.unit);
    }
    events_.push({Locked(merged), Kind::kArrived, index, ""});
  }

  // When a call that comes at `time` has had the table to itself.
  double Locked(double time) { return table_.Serve(time, c_.call); }

  void Arrive(int index) {
    Node& node = nodes_[static_cast<size_t>(index)];
    for (const std::string& lease : node.sent) {
      const LeaseState& held = state_.leases.at(lease);
      if (!held.revoked) {
        const UnitRef unit = held.unit;
        const UnitState& done = state_.steps.at("job").units[static_cast<size_t>(unit.unit)];
        left_ -= static_cast<size_t>(done.grains.count);
        ++units_;
        FinishUnit(state_, unit, "", "", c_.ray * static_cast<double>(done.rays),
                   ToSeconds(At(now_) - held.granted));
      }
      RemoveLease(state_, lease, false);
    }
    node.sent.clear();
    Send(index);
    Dispatch();
  }

  template <typename Policy>
  std::vector<Grant> Timed(const Policy& policy) {
    const double start = ProcessorSeconds();
    std::vector<Grant> grants = policy();
    policy_seconds_ += ProcessorSeconds() - start;
    ++policy_calls_;
    return grants;
  }

  void Dispatch() {
    Lend(Timed([this] { return NextLeases(state_, At(now_), options_); }));
  }

  void Lend(const std::vector<Grant>& grants) {
    state_.revoked.clear();
    std::map<int, bool> told;
    for (const Grant& grant : grants) {
      const int unit =
          grant.new_grains.count > 0 ? CutUnit(state_, "job", grant.new_grains) : grant.unit;
      const std::string lease = std::to_string(next_lease_++);
      AddLease(state_, {"job", unit}, grant.session, lease, At(now_));
      const int node = by_name_.at(grant.session);
      events_.push({now_ + c_.latency, Kind::kGranted, node, lease});
      told[node] = true;
    }
    for (const auto& [node, is_told] : told) {
      SetWaiting(state_, nodes_[static_cast<size_t>(node)].name, false);
      events_.push({Locked(now_ + 2 * c_.latency), Kind::kAsks, node, ""});
    }
  }

  const Constants c_;
  const double patches_;
  WorkOptions options_;
  WorkState state_;
  std::vector<Node> nodes_;
  std::map<std::string, int> by_name_;
  std::priority_queue<Event> events_;
  Server link_, merging_, table_;
  std::vector<Server> processors_;         // of who merges: the coordinator, or a shard
  std::vector<Server> ledger_processors_;  // of the coordinator, while shards merge
  double now_ = 0, rays_ = 0, bytes_ = 0, policy_seconds_ = 0;
  int64_t number_ = 0, next_lease_ = 0, units_ = 0, policy_calls_ = 0;
  size_t left_ = 0;  // grains of the step that are not merged
  int shards_ = 0;   // of the step
  int steps_ = 0;
};

int Main(int argc, char** argv) {
  if (argc == 2 && std::strcmp(argv[1], "--header") == 0) {
    Simulation::PrintHeader();
    return 0;
  }
  Constants constants;
  for (int i = 3; i < argc; ++i) {
    const std::string argument = argv[i];
    const size_t equals = argument.find('=');
    auto key = Keys().find(argument.substr(0, equals));
    if (equals == std::string::npos || key == Keys().end()) {
      std::fprintf(stderr, "error: %s: there is no such constant; see Constants\n", argv[i]);
      return 2;
    }
    constants.*key->second = std::atof(argument.c_str() + equals + 1);
  }
  if (argc < 3) {
    std::fprintf(stderr, "usage: simulate_farm NODES PATCHES [KEY=VALUE...] | --header\n");
    return 2;
  }
  Simulation simulation(std::atoi(argv[1]), std::atof(argv[2]), constants);
  simulation.RunPass();
  simulation.Print();
  return 0;
}

}  // namespace
}  // namespace lambert::server

int main(int argc, char** argv) { return lambert::server::Main(argc, argv); }
