// How much work waits, and who is there for it.
#pragma once

#include <cstdint>

#include "server/work/work_state.h"

namespace lambert::server {

struct WorkLoad {
  int64_t queued_rays = 0;    // of published units and grains that nobody holds
  double queued_seconds = 0;  // of one slot, at the pace of their jobs
  int leases = 0;
  int workers = 0;
  int slots = 0;
};

// A job whose pace is not known yet counts 1e-6 s a ray.
WorkLoad LoadOf(const WorkState& state);

}  // namespace lambert::server
