// What a bench tells: its table on standard output, and run.json.
#pragma once

#include <string>

#include "app/bench_scene.h"
#include "nlohmann/json_fwd.hpp"

namespace lambert::app {

// A few lines about the reference, then one aligned line for each method and budget.
std::string BenchText(const BenchResult& result);

// The same as one object, with all digits; also the content of run.json.
nlohmann::ordered_json BenchJson(const Options& options, const BenchResult& result);

// "room: 1450 patches, 4 seeds; reference: ..., residual 0.12 %": the headline of table and
// figures.
std::string BenchHeadline(const BenchResult& result);

}  // namespace lambert::app
