// The figure of what the methods of a bench cost beside their error.
#pragma once

#include <string>

#include "app/bench_scene.h"

namespace lambert::app {

// costs.dat: a line for each method at the largest budget that it ran.
std::string CostData(const BenchResult& result);

// costs.gp: bars of memory, of the time to the first rays, and of the CPU time of a million rays.
std::string CostScript(const BenchResult& result);

}  // namespace lambert::app
