// Options of a job <-> what of them travels: a client writes it, a server reads it.
#pragma once

#include "absl/status/status.h"
#include "radiosity/patch/build_patches.h"
#include "radiosity/solve/options.h"

namespace lambert {
namespace v1 {
class SolveSpec;
}  // namespace v1

v1::SolveSpec MakeSpec(const PatchOptions& patch, const SolveOptions& solve);

// Absent fields keep their defaults. Takes over all that it knows; the first method or setting that
// it does not know fails with FIELD_INVALID, which a client may ignore: such a method becomes
// kAuto, such a setting changes nothing.
absl::Status ReadSpec(const v1::SolveSpec& spec, PatchOptions& patch, SolveOptions& solve);

}  // namespace lambert
