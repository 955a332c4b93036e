// The constants of simulate_farm (docs/scaling.md).
#pragma once

#include <map>
#include <string>

namespace lambert::server {

// What the model takes; times in seconds. Measured as docs/scaling.md says.
struct Constants {
  double slots = 16;             // of a node
  double rays_per_patch = 1000;  // of the pass
  double reflected = 0.5;        // rays of a step, of those of the step before
  double ray = 0.17e-6;          // tracing, one core
  double unit = 300e-6;          // coordinator's processor: a grant, a sync, a result's calls
  double byte = 3e-9;            // ... and a byte of a result: hash, decode, check, merge
  double merge_byte = 0.5e-9;    // of that: merging, one result at a time
  double step = 0.5e-3;          // latency of publishing a step and of its first grants
  double patch = 10e-9;          // allocating and booking, a patch and step
  double cores = 16;             // of the coordinator
  double bandwidth = 1.25e9;  // bytes a second: into the coordinator, into a shard, out of a node
  double call = 10e-6;        // the table's lock, a call
  double latency = 0.1e-3;    // of a message
  double shards = 0;          // merge shards, each like the coordinator; 0: it merges itself
  double units_per_slot = 2;  // WorkOptions
  double max_unit_rays = 1 << 21;  // WorkOptions
  double rays_per_sum = 0.45;      // WorkOptions; next to nothing: all nodes take part in all steps
  double combine = 1;              // 1: units that ended travel as one result; 0: one by one
  double deposit_bytes = 32;       // of a patch that was hit, in a result
  double evenness = 0.3;  // of hits: their number on a patch has a gamma distribution of this shape
  double by_step = 0;     // 1: a line a step instead of one of the pass
};

// By their names on the command line.
inline const std::map<std::string, double Constants::*>& Keys() {
  static const std::map<std::string, double Constants::*> keys = {
      {"slots", &Constants::slots},
      {"rays_per_patch", &Constants::rays_per_patch},
      {"reflected", &Constants::reflected},
      {"ray", &Constants::ray},
      {"unit", &Constants::unit},
      {"byte", &Constants::byte},
      {"merge_byte", &Constants::merge_byte},
      {"step", &Constants::step},
      {"patch", &Constants::patch},
      {"cores", &Constants::cores},
      {"bandwidth", &Constants::bandwidth},
      {"call", &Constants::call},
      {"latency", &Constants::latency},
      {"shards", &Constants::shards},
      {"units_per_slot", &Constants::units_per_slot},
      {"max_unit_rays", &Constants::max_unit_rays},
      {"rays_per_sum", &Constants::rays_per_sum},
      {"combine", &Constants::combine},
      {"deposit_bytes", &Constants::deposit_bytes},
      {"evenness", &Constants::evenness},
      {"by_step", &Constants::by_step},
  };
  return keys;
}

}  // namespace lambert::server
