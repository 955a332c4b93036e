// Between the options that travel and the options that the library takes.
#pragma once

#include "absl/status/statusor.h"
#include "lambert/v1/snapshot.pb.h"
#include "lambert/v1/solve_job_service.pb.h"
#include "lambert/v1/solve_spec.pb.h"
#include "radiosity/core/warning.h"
#include "radiosity/patch/build_patches.h"
#include "radiosity/solve/adapt_mesh.h"
#include "radiosity/solve/plan.h"
#include "radiosity/solve/solution.h"
#include "radiosity/solve/solver.h"

namespace lambert::server {

struct JobOptions {
  PatchOptions patch;
  SolveOptions solve;
};

// Absent fields take their defaults. FIELD_INVALID names the field that is out of range.
absl::StatusOr<JobOptions> DecodeSpec(const v1::SolveSpec& spec, int64_t max_patches);

// `asked` with what the planner filled in.
v1::Plan EncodePlan(const Plan& plan, const v1::SolveSpec& asked);
v1::Progress EncodeProgress(const Progress& progress);
v1::Meshing EncodeMeshing(const Meshing& meshing);
Meshing DecodeMeshing(const v1::Meshing& proto);
v1::Warning EncodeWarning(const Warning& warning);
v1::SolveJob::StopReason EncodeStopReason(StopReason reason);

}  // namespace lambert::server
