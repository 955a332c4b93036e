// density_bench [Google Benchmark's flags]: what the densities of one patch cost, beside a ray. The
// constants of radiosity/shoot/directions.cc are of it.
//
// `Count/N`, `CountVertices/N` and `LeastVariance/N` compute the densities of one patch after the
// other, spread over a Cornell box of 32 patches (N 0) or an office of 222 N^2: 64 spherical
// triangles by counting, in clusters or vertex by vertex, and 64 squares from the tree of targets.
// Counter `ns_per_patch`: of all patches of the scene; `ns_per_cell`: of the 64.
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

PatchSet SceneOf(const benchmark::State& state) {
  const int n = static_cast<int>(state.range(0));
  return PatchesOf(n == 0 ? MakeCornell(1) : MakeOffice(n));
}

void MeasureCount(benchmark::State& state, bool use_clusters) {
  const PatchSet patches = SceneOf(state);
  const ClusterTree clusters(patches.corners, CountedPatches(patches, /*count_black=*/false, true));
  const Hemisphere cells(4, 4, 2);
  Measure(state, patches, cells.size(), [&](const LocalFrame& frame) {
    return clusters.CountPatches(frame, cells, use_clusters);
  });
}

void Count(benchmark::State& state) { MeasureCount(state, /*use_clusters=*/true); }
void CountVertices(benchmark::State& state) { MeasureCount(state, /*use_clusters=*/false); }

void LeastVariance(benchmark::State& state) {
  const PatchSet patches = SceneOf(state);
  const TargetTree targets(patches, ErrorWorth(patches, 0));
  const ConcentricGrid cells(8);
  const double opening = 0.6 * std::sqrt(2 * std::numbers::pi / cells.size());
  Measure(state, patches, cells.size(),
          [&](const LocalFrame& frame) { return targets.Moments(frame, cells, opening); });
}

// Offices of 222, 888, 10,878 and 97,902 patches.
BENCHMARK(Count)->Arg(0)->Arg(1)->Arg(2)->Arg(7)->Arg(21)->Unit(benchmark::kMicrosecond);
BENCHMARK(CountVertices)->Arg(0)->Arg(1)->Arg(2)->Arg(7)->Unit(benchmark::kMicrosecond);
BENCHMARK(LeastVariance)->Arg(7)->Arg(21)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace lambert

BENCHMARK_MAIN();
