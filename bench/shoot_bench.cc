// shoot_bench [--rays=N] [--turns=N] [--digests] [Google Benchmark's flags]: how much of bare
// Embree's throughput is left when rays are also sampled and deposited.
//
// Every benchmark `Ratio/PATCHES/RAYS_PER_VISIT/METHOD` takes turns between rtcIntersect16 on rays
// that lie ready and Shooter::Run, which makes, traces and deposits the same rays. Its time is that
// of Shooter::Run, its counter `ratio` the median over the turns of bare time over run time; the
// other counters are the stages alone, in ns a ray. A table and the worst ratios end the program.
#include <benchmark/benchmark.h>
#include <pmmintrin.h>
#include <xmmintrin.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "bench/shoot_case.h"

namespace lambert {
namespace {

struct Settings {
  int64_t rays = 1 << 18, turns = 20;
  bool digests = false;
};

struct NamedOptions {
  const char* name;
  ShootOptions options;
};

struct Row {
  PatchIndex patches;
  uint32_t rays_per_visit;
  std::string method, digest;
  double ratio;
  TurnTimes turn;
  StageTimes stages;
};

std::vector<NamedOptions> Methods() {
  std::vector<NamedOptions> methods;
  const auto add = [&](const char* name, Method method) -> ShootOptions& {
    methods.push_back({name, {}});
    methods.back().options.method = method;
    methods.back().options.pyramids.min_rays = 1;  // densities however few rays a visit has
    return methods.back().options;
  };
  add("pmcr", Method::kPmcr);
  add("mcr", Method::kMcr);
  add("pmcr-sobol", Method::kPmcr).sequence = Sequence::kSobol;
  add("phs-projected", Method::kPhs);
  add("phs-solid", Method::kPhs).pyramids.sampling = PyramidSampling::kSolidAngle;
  add("phs-squares", Method::kPhs).pyramids.cells = CellShape::kSquare;
  add("hs97", Method::kHs97);
  add("hs98", Method::kHs98);
  return methods;
}

// Cells per edge of MakeOffice: 10,878, 97,902 and 996,558 patches.
constexpr int kOffices[] = {7, 21, 67};
constexpr uint32_t kRaysPerVisit[] = {1, 16, 256};

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

template <typename Times>
double MedianOf(const std::vector<Times>& times, double Times::*member) {
  std::vector<double> values;
  for (const Times& t : times) values.push_back(t.*member);
  return Median(values);
}

// The scene of the benchmarks that run now; one at a time, as the large ones take much memory.
BenchScene& SceneOf(int n) {
  static int current = 0;
  static std::unique_ptr<BenchScene> scene;
  if (n != current) {
    scene.reset();
    scene = BenchScene::Make(n);
    current = n;
  }
  return *scene;
}

void MeasureRatio(benchmark::State& state, int n, uint32_t rays_per_visit,
                  const NamedOptions& method, const Settings& settings, std::vector<Row>& rows) {
  BenchScene& scene = SceneOf(n);
  ShootCase shoot(scene, method.options, rays_per_visit, settings.rays);
  std::vector<TurnTimes> turns;
  std::vector<StageTimes> stages;
  std::vector<double> ratios;
  for (auto _ : state) {
    turns.push_back(shoot.Turn());
    ratios.push_back(turns.back().bare16 / turns.back().run);
    state.SetIterationTime(1e-9 * turns.back().run * static_cast<double>(settings.rays));
    if (turns.size() % 4 == 1) stages.push_back(shoot.Stages());
  }
  Row row{scene.patches->size(), rays_per_visit, method.name, {}, Median(ratios), {}, {}};
  for (double TurnTimes::*m : {&TurnTimes::bare16, &TurnTimes::run}) {
    row.turn.*m = MedianOf(turns, m);
  }
  for (double StageTimes::*m : {&StageTimes::sample, &StageTimes::trace, &StageTimes::deposit,
                                &StageTimes::bare8, &StageTimes::fast16}) {
    row.stages.*m = MedianOf(stages, m);
  }
  if (settings.digests) row.digest = shoot.ResultDigest();
  state.counters["ratio"] = row.ratio;
  state.counters["sample"] = row.stages.sample;
  state.counters["trace"] = row.stages.trace;
  state.counters["deposit"] = row.stages.deposit;
  rows.push_back(row);
}

void PrintTable(const std::vector<Row>& rows, bool digests) {
  std::printf(
      "\n| patches | rays a visit | method | ns/ray | sample | trace | deposit | intersect16 | "
      "ratio | intersect8 | 16 not robust |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const Row& r : rows) {
    std::printf("| %d | %u | %s | %.1f | %.1f | %.1f | %.1f | %.1f | %.3f | %.1f | %.1f |%s%s\n",
                r.patches, r.rays_per_visit, r.method.c_str(), r.turn.run, r.stages.sample,
                r.stages.trace, r.stages.deposit, r.turn.bare16, r.ratio, r.stages.bare8,
                r.stages.fast16, digests ? " " : "", r.digest.substr(0, 16).c_str());
  }
}

void PrintWorst(const std::vector<Row>& rows, bool one_ray, double target) {
  const Row* worst = nullptr;
  for (const Row& row : rows) {
    if ((row.rays_per_visit == 1) != one_ray) continue;
    if (worst == nullptr || row.ratio < worst->ratio) worst = &row;
  }
  if (worst == nullptr) return;
  std::printf("worst ratio with %s: %.3f (%d patches, %u rays, %s); aim %.2f\n",
              one_ray ? "1 ray a visit" : "16 or more rays a visit", worst->ratio, worst->patches,
              worst->rays_per_visit, worst->method.c_str(), target);
}

// Takes this program's own flags out of the arguments; Google Benchmark takes the rest.
Settings TakeSettings(int& argc, char** argv) {
  Settings settings;
  int kept = 1;
  for (int k = 1; k < argc; ++k) {
    if (std::strncmp(argv[k], "--rays=", 7) == 0) {
      settings.rays = std::max(1LL, std::atoll(argv[k] + 7));
    } else if (std::strncmp(argv[k], "--turns=", 8) == 0) {
      settings.turns = std::max(1LL, std::atoll(argv[k] + 8));
    } else if (std::strcmp(argv[k], "--digests") == 0) {
      settings.digests = true;
    } else {
      argv[kept++] = argv[k];
    }
  }
  argc = kept;
  return settings;
}

int Main(int argc, char** argv) {
  // As Shooter::Run has it.
  _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
  _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
  const Settings settings = TakeSettings(argc, argv);
  const std::vector<NamedOptions> methods = Methods();
  std::vector<Row> rows;
  for (int n : kOffices) {
    for (uint32_t rays_per_visit : kRaysPerVisit) {
      for (const NamedOptions& method : methods) {
        const std::string name = "Ratio/" + std::to_string(222 * n * n) + "/" +
                                 std::to_string(rays_per_visit) + "/" + method.name;
        benchmark::RegisterBenchmark(name.c_str(),
                                     [&, n, rays_per_visit](benchmark::State& state) {
                                       MeasureRatio(state, n, rays_per_visit, method, settings,
                                                    rows);
                                     })
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond)
            ->Iterations(settings.turns);
      }
    }
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  PrintTable(rows, settings.digests);
  PrintWorst(rows, /*one_ray=*/false, 0.90);
  PrintWorst(rows, /*one_ray=*/true, 0.85);
  return 0;
}

}  // namespace
}  // namespace lambert

int main(int argc, char** argv) { return lambert::Main(argc, argv); }
