// The options of a job as they travel: a serialized lambert.v1.SolveSpec.
#include "server/jobs/spec.h"
#include "tests/fuzz/fuzz.h"

namespace lambert {

void FuzzOne(const std::string& bytes) {
  v1::SolveSpec spec;
  if (!spec.ParseFromString(bytes)) return;
  const absl::StatusOr<server::JobOptions> options = server::DecodeSpec(spec, 10'000);
  if (!options.ok()) return;
  Expect(options->patch.max_patches <= 10'000, "the server's limit holds");
}

}  // namespace lambert
