// Protocol messages <-> the types of this library. The one place where a client names their fields.
#pragma once

#include "client/job.h"
#include "lambert/v1/farm_service.pb.h"
#include "lambert/v1/solve_job_service.pb.h"

namespace lambert::client {

Progress FromProto(const v1::Progress& progress);
Plan FromProto(const v1::Plan& plan);
BlobRef FromProto(const v1::Digest& digest);
Job FromProto(const v1::SolveJob& job);
Worker FromProto(const v1::Worker& worker);

}  // namespace lambert::client
