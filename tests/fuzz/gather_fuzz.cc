#include "radiosity/gather/gather_points.h"
#include "tests/fuzz/fuzz.h"

namespace lambert {

void FuzzOne(const std::string& bytes) {
  if (const auto points = DecodeGatherPoints(bytes); points.ok()) {
    Expect(EncodeGatherPoints(*points) == bytes, "points have one encoding");
  }
  if (const auto task = DecodeGatherTask(bytes); task.ok()) {
    Expect(EncodeGatherTask(*task) == bytes, "a gather task has one encoding");
  }
  if (const auto gathered = DecodeGathered(bytes); gathered.ok()) {
    Expect(gathered->irradiance_lx.size() == gathered->std_error_lx.size(), "each has its error");
  }
}

}  // namespace lambert
