// density_bench [Google Benchmark's flags]: what the densities of one patch cost, beside a ray. The
// constants of radiosity/shoot/directions.cc are of it.
//
// `Count/PATCHES` and `LeastVariance/PATCHES` compute the densities of one patch after the other,
// spread over an office of so many patches: 64 spherical triangles by counting, 64 squares from the
// tree of targets. Counter `ns_per_patch`: of all patches of the scene; `ns_per_cell`: of the 64.
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "radiosity/pyramid/cluster_tree.h"
#include "radiosity/pyramid/concentric_grid.h"
#include "radiosity/pyramid/hemisphere.h"
#include "radiosity/pyramid/target_tree.h"
#include "radiosity/shoot/directions.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

constexpr PatchIndex kStride = 997;  // prime: patches all over the scene

template <typename Compute>
void Measure(benchmark::State& state, const PatchSet& patches, size_t cells, Compute compute) {
  PatchIndex patch = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(compute(PatchFrame(patches, patch)));
    patch = (patch + kStride) % patches.size();
  }
  using benchmark::Counter;
  const auto per = [&](double count) {
    return Counter(1e-9 * count, Counter::kIsIterationInvariantRate | Counter::kInvert);
  };
  state.counters["ns_per_patch"] = per(patches.size());
  state.counters["ns_per_cell"] = per(static_cast<double>(cells));
}

void Count(benchmark::State& state) {
  const PatchSet patches = PatchesOf(MakeOffice(static_cast<int>(state.range(0))));
  const ClusterTree clusters(patches.corners, CountedPatches(patches, /*count_black=*/false));
  const Hemisphere cells(4, 4, 2);
  Measure(state, patches, cells.size(),
          [&](const LocalFrame& frame) { return clusters.CountPatches(frame, cells); });
}

void LeastVariance(benchmark::State& state) {
  const PatchSet patches = PatchesOf(MakeOffice(static_cast<int>(state.range(0))));
  const TargetTree targets(patches, ErrorWorth(patches, 0));
  const ConcentricGrid cells(8);
  const double opening = 0.6 * std::sqrt(2 * std::numbers::pi / cells.size());
  Measure(state, patches, cells.size(),
          [&](const LocalFrame& frame) { return targets.Moments(frame, cells, opening); });
}

// Cells per edge of MakeOffice: 10,878 and 97,902 patches.
BENCHMARK(Count)->Arg(7)->Arg(21)->Unit(benchmark::kMicrosecond);
BENCHMARK(LeastVariance)->Arg(7)->Arg(21)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace lambert

BENCHMARK_MAIN();
