// gather_bench SCENE FINE_EDGE_M POINTS [RAYS [SPLIT...]]: how far gathered irradiance is from
// continuous truth, beside that of constant patches; and what a gather's ray costs.
//
// The truth at points drawn evenly over the scene's surfaces: gathered with kTruthRays rays from a
// solution of the scene split to FINE_EDGE_M; its residual is the difference of two such, of other
// seeds, the second split to edges half again as long. Errors are RMS over the points of
// reflectance times irradiance, over the mean of that. RAYS: of each of the solutions (2e7).
// SPLIT: others whose solutions are compared, as they are and gathered from with 1,024 rays: an
// edge in metres, "cut" for crossings alone (patch/cut_crossings.h), or "adapt=PATCHES". All are by
// the method walk.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "absl/strings/str_cat.h"
#include "radiosity/core/philox.h"
#include "radiosity/gather/gather.h"
#include "radiosity/patch/build_patches.h"
#include "radiosity/scene/load_gltf.h"
#include "radiosity/shoot/this_thread.h"
#include "radiosity/solve/adapt_mesh.h"
#include "radiosity/solve/plan.h"
#include "radiosity/solve/solver.h"

namespace lambert {
namespace {

constexpr int kTruthRays = 1 << 13;

struct Solved {
  std::shared_ptr<const PatchSet> patches;
  std::shared_ptr<const Solution> solution;
  double rays_per_cpu_second = 0;
};

Solved SolveWith(std::shared_ptr<const PatchSet> patches, const SolveOptions& options) {
  Solved solved;
  solved.patches = std::move(patches);
  const Plan plan = MakePlan(*solved.patches, options);
  SerialExecutor executor(*Shooter::Create(solved.patches, plan.options.shoot));
  Solver solver(solved.patches, plan.options, [] { return ThreadCpuSeconds(); });
  while (solver.stop_reason() == StopReason::kNone) {
    if (!solver.RunPass(executor, nullptr).ok()) std::abort();
  }
  const Snapshot snapshot = solver.MakeSnapshot();
  solved.solution = snapshot.solution;
  solved.rays_per_cpu_second =
      static_cast<double>(snapshot.progress.rays) / snapshot.progress.cpu_seconds;
  return solved;
}

SolveOptions Options(uint64_t seed, int64_t rays) {
  SolveOptions options;
  options.shoot.method = Method::kWalk;
  options.seed = seed;
  options.max_rays = rays;
  return options;
}

Solved Solve(const Scene& scene, double max_edge_m, uint64_t seed, int64_t rays) {
  PatchOptions split;
  split.max_edge_m = max_edge_m;
  return SolveWith(std::make_shared<const PatchSet>(*BuildPatches(scene, split)),
                   Options(seed, rays));
}

// The scene in a SPLIT of the command line.
std::shared_ptr<const PatchSet> SplitAs(const Scene& scene, const std::string& split,
                                        int64_t rays) {
  constexpr int64_t kMostPieces = 1'000'000;
  PatchOptions options;
  if (split == "cut") {
    return std::make_shared<const PatchSet>(
        *BuildPatches(scene, options, FindCrossings(scene, options, kMostPieces)));
  }
  if (!split.starts_with("adapt=")) {
    options.max_edge_m = std::atof(split.c_str());
    return std::make_shared<const PatchSet>(*BuildPatches(scene, options));
  }
  options.adapt_patches = std::atoll(split.c_str() + split.find('=') + 1);
  SolveOptions wanted = Options(4, 4 * rays);  // of which pilots have a quarter
  wanted.max_error = 1e-6;
  Meshing meshing;
  const auto run = [&](const std::shared_ptr<const PatchSet>& patches, const SolveOptions& pilot,
                       int32_t) -> absl::StatusOr<Solution> {
    return *SolveWith(patches, pilot).solution;
  };
  auto patches = *AdaptMesh(scene, options, wanted, run, &meshing);
  std::printf("%s, %d pilots: %s\n", split.c_str(), meshing.pilots, meshing.reason.c_str());
  return patches;
}

// Points on patches, relative to the origin of their set, and the patches that they lie on.
struct Places {
  GatherPoints points;
  std::vector<PatchIndex> patch;
};

Places DrawPlaces(const PatchSet& patches, size_t count) {
  std::vector<double> until;
  double total = 0;
  for (double area : patches.area_m2) until.push_back(total += area);
  Places places;
  for (size_t k = 0; k < count; ++k) {
    const auto xi = RandomNumbers({99, static_cast<uint32_t>(k), 0, 0}, 0, RandomPurpose::kRay);
    const double at = total * (static_cast<double>(k) + xi[0]) / static_cast<double>(count);
    const auto found = std::upper_bound(until.begin(), until.end() - 1, at);
    const auto i = static_cast<PatchIndex>(found - until.begin());
    const double root = std::sqrt(xi[1]);
    const auto& corners = patches.corners[i];
    places.points.Add(
        corners[0] * (1 - root) + corners[1] * (root * (1 - xi[2])) + corners[2] * (root * xi[2]),
        PatchNormal(patches, i));
    places.patch.push_back(i);
  }
  return places;
}

// The patches of another split that the places lie on.
std::vector<PatchIndex> FindIn(const PatchSet& split, const PatchSet& patches,
                               const Places& places) {
  const auto key = [](const PatchSet& set, PatchIndex i) {
    const PatchSource& source = set.source[i];
    return std::tuple(source.node, source.mesh, source.primitive, source.triangle, set.is_back[i]);
  };
  std::map<decltype(key(split, 0)), std::vector<PatchIndex>> parts;
  for (PatchIndex i = 0; i < split.size(); ++i) parts[key(split, i)].push_back(i);
  std::vector<PatchIndex> found;
  for (size_t k = 0; k < places.patch.size(); ++k) {
    const Vec3 p = places.points.position_m[k] + patches.origin - split.origin;
    PatchIndex best = 0;
    double most = -std::numeric_limits<double>::infinity();
    for (PatchIndex i : parts[key(patches, places.patch[k])]) {
      const auto& corners = split.corners[i];
      const Vec3 normal = PatchNormal(split, i);
      double least = std::numeric_limits<double>::infinity();
      for (int e = 0; e < 3; ++e) {
        const Vec3 a = corners[e], way = corners[(e + 1) % 3] - a;
        least = std::min(least, Dot(Cross(normal, way), p - a) / Length(way));
      }
      if (least > most) {
        most = least;
        best = i;
      }
    }
    found.push_back(best);
  }
  return found;
}

std::vector<Rgb> ConstantAt(const Solved& solved, const std::vector<PatchIndex>& patches) {
  std::vector<Rgb> constant;
  for (PatchIndex i : patches) constant.push_back(solved.solution->irradiance_lx[i]);
  return constant;
}

struct Timed {
  std::vector<Rgb> irradiance_lx;
  double rays_per_cpu_second = 0;
};

Timed GatherFrom(const Solved& solved, const Vec3& origin, const GatherPoints& points, int rays) {
  GatherPoints moved = points;
  for (Vec3& p : moved.position_m) p = p + origin - solved.patches->origin;
  const auto gatherer =
      *Gatherer::Create(solved.patches, solved.solution->radiosity_lm_per_m2, {rays, 5});
  const double start = ThreadCpuSeconds();
  const Gathered gathered = gatherer->Run(moved, 0, moved.size());
  const double seconds = ThreadCpuSeconds() - start;
  return {gathered.irradiance_lx, 2.0 * rays * static_cast<double>(points.size()) / seconds};
}

class Judge {
 public:
  Judge(const PatchSet& patches, const Places& places, const std::vector<Rgb>& truth)
      : patches_(patches), places_(places), truth_(truth) {}

  // Prints RMS error and bias, in per cent of the mean.
  void Print(const std::string& what, const std::vector<Rgb>& irradiance_lx) const {
    double squares = 0, difference = 0, sum = 0;
    for (size_t k = 0; k < truth_.size(); ++k) {
      const Rgb& rho = patches_.reflectance[places_.patch[k]];
      const double right = Mean(rho * truth_[k]), d = Mean(rho * irradiance_lx[k]) - right;
      squares += d * d;
      difference += d;
      sum += right;
    }
    const double count = static_cast<double>(truth_.size()), mean = sum / count;
    std::printf("%-28s rms %7.3f %%   bias %+7.3f %%\n", what.c_str(),
                100 * std::sqrt(squares / count) / mean, 100 * difference / count / mean);
    std::fflush(stdout);
  }

 private:
  const PatchSet& patches_;
  const Places& places_;
  const std::vector<Rgb>& truth_;
};

void Run(const std::string& path, double fine_edge_m, size_t count, int64_t rays,
         const std::vector<std::string>& splits) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const auto scene = LoadGltf({path.substr(path.rfind('/') + 1), bytes, {}});
  if (!scene.ok()) {
    std::fprintf(stderr, "%s\n", scene.status().ToString().c_str());
    std::exit(1);
  }
  const Solved coarse = Solve(*scene, 0, 1, rays);
  const Solved fine = Solve(*scene, fine_edge_m, 2, rays);
  const Solved less_fine = Solve(*scene, 1.5 * fine_edge_m, 3, rays);
  std::printf("%d patches; truth from %d and %d\n", coarse.patches->size(), fine.patches->size(),
              less_fine.patches->size());
  const Places places = DrawPlaces(*coarse.patches, count);
  const Vec3 origin = coarse.patches->origin;
  const Timed truth = GatherFrom(fine, origin, places.points, kTruthRays);
  const Judge judge(*coarse.patches, places, truth.irradiance_lx);
  judge.Print("residual of the truth",
              GatherFrom(less_fine, origin, places.points, kTruthRays).irradiance_lx);
  judge.Print("constant patches", ConstantAt(coarse, places.patch));
  for (int gather_rays : {16, 64, 256, 1024, 4096}) {
    const Timed gathered = GatherFrom(coarse, origin, places.points, gather_rays);
    judge.Print("gathered, " + std::to_string(gather_rays) + " rays", gathered.irradiance_lx);
    std::printf("  %.3g rays per CPU second; shooting %.3g; ratio %.2f\n",
                gathered.rays_per_cpu_second, coarse.rays_per_cpu_second,
                gathered.rays_per_cpu_second / coarse.rays_per_cpu_second);
  }
  for (const std::string& name : splits) {
    const Solved split = SolveWith(SplitAs(*scene, name, rays), Options(4, rays));
    const std::string what = absl::StrCat(name, ", ", split.patches->size(), " patches");
    judge.Print(what, ConstantAt(split, FindIn(*split.patches, *coarse.patches, places)));
    judge.Print(what + ", gathered", GatherFrom(split, origin, places.points, 1024).irradiance_lx);
  }
}

}  // namespace
}  // namespace lambert

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: gather_bench SCENE FINE_EDGE_M POINTS [RAYS [SPLIT...]]\n");
    return 2;
  }
  const std::vector<std::string> splits(argv + std::min(argc, 5), argv + argc);
  lambert::Run(argv[1], std::atof(argv[2]), static_cast<size_t>(std::atoll(argv[3])),
               argc > 4 ? static_cast<int64_t>(std::atof(argv[4])) : 20'000'000, splits);
  return 0;
}
