// What the user asked the `lambert` command to do: flags, environment and lambert.toml, merged.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "net/credentials.h"
#include "radiosity/lightmap/atlas.h"
#include "radiosity/output/write_outputs.h"
#include "radiosity/patch/build_patches.h"
#include "radiosity/scene/load_gltf.h"
#include "radiosity/solve/options.h"

namespace lambert::app {

enum class Command {
  kBake,
  kPlan,
  kSubmit,
  kWatch,
  kFetch,
  kCancel,
  kDelete,
  kJobs,
  kWorkers,
  kCompare,
  kBench,
};

enum class ProgressMode { kAuto, kBar, kPlain, kJson, kNone };

// When one run of a bench ends: one of both is 0.
struct BenchBudget {
  int64_t rays = 0;
  double seconds = 0;
};

// What only `lambert bench` asks for.
struct BenchOptions {
  std::vector<std::string> scenes;   // .glb or .gltf files
  std::vector<std::string> methods;  // as written (bench_list.h); empty: all
  int seeds = 4;                     // > 0: solve.seed and those after it
  std::vector<BenchBudget> budgets;  // empty: from solve.max_rays and solve.max_time_s
  int64_t reference_rays = 0;        // both halves together; 0: kReferenceFactor times the largest
  double reference_error = 0;        // wanted residual of the reference; 0: none wanted
};

struct Options {
  Options() { solve.shoot.method = Method::kAuto; }

  Command command = Command::kBake;

  std::string scene_path;              // bake, plan, submit: a .glb or .gltf file
  std::string sky_path;                // that patch.lights.sky is of; "": none
  std::vector<std::string> ies_paths;  // of patch.lights.lamps
  std::string job;                     // watch, fetch, cancel, delete: "solveJobs/ID"
  std::string out_folder;              // bake, fetch, bench
  OutputFiles outputs;                 // bake, fetch
  PictureOptions picture;              // bake, fetch
  bool lightmap = false;               // bake
  LightmapOptions lightmap_options;
  int final_gather_rays = 0;      // bake, fetch: a point; 0: none
  std::string sensors_path;       // bake, fetch: a file of sensors; "": none
  double work_plane_m = 0;        // bake, fetch: height of a work plane over each floor; 0: none
  std::string compare_path;       // compare: the table that is judged
  std::string compare_reference;  // compare: the table that it is judged by

  PatchOptions patch;
  SceneLimits limits;  // of what is read here; a server has its own
  SolveOptions solve;
  BenchOptions bench;

  std::string server;           // HOST:PORT; "": the whole service in this process
  CredentialFiles credentials;  // shown to the server
  double reconnect_s = 60;      // how long a server that has gone is tried again, seconds
  int workers = 1;              // in this process, > 0
  int threads = 0;              // of each of those workers; 0: the processor's, shared out

  std::string reference_path;        // a patches.csv to measure the error against; "": none
  std::vector<std::string> regions;  // nodes of the local error: names or glTF indices

  bool watch_list = false;  // jobs, workers: until Ctrl-C
  bool json = false;        // results as JSON
  ProgressMode progress = ProgressMode::kAuto;
};

}  // namespace lambert::app
