#include "radiosity/shoot/options_codec.h"

#include "radiosity/core/bytes.h"
#include "radiosity/core/error.h"

namespace lambert {
namespace {

constexpr uint32_t kOptionsMagic = 0x314F534C;  // "LSO1"

struct OptionsBytes {
  uint32_t magic = kOptionsMagic;
  uint8_t method = 0, sampling = 0, count_black = 0, use_clusters = 0;
  int32_t initial = 0, split = 0, depth = 0, reserved = 0;
  double alpha1 = 0, alpha2 = 0;
  int64_t min_rays = 0;
};
static_assert(sizeof(OptionsBytes) == 48);

}  // namespace

std::string EncodeShootOptions(const ShootOptions& options) {
  const PyramidOptions& p = options.pyramids;
  OptionsBytes bytes;
  bytes.method = static_cast<uint8_t>(options.method);
  bytes.sampling = static_cast<uint8_t>(p.sampling);
  bytes.count_black = p.count_black;
  bytes.use_clusters = p.use_clusters;
  bytes.initial = p.initial;
  bytes.split = p.split;
  bytes.depth = p.depth;
  bytes.alpha1 = p.alpha1;
  bytes.alpha2 = p.alpha2;
  bytes.min_rays = p.min_rays;
  ByteWriter writer;
  writer.Put(bytes);
  return writer.Take();
}

absl::StatusOr<ShootOptions> DecodeShootOptions(const std::string& bytes) {
  ByteReader reader(bytes);
  OptionsBytes read;
  if (!reader.Get(&read) || !reader.Complete() || read.magic != kOptionsMagic ||
      read.method > static_cast<uint8_t>(Method::kPhs) ||
      read.sampling > static_cast<uint8_t>(PyramidSampling::kProjectedAngle)) {
    return MakeError(absl::StatusCode::kDataLoss,
                     {"OPTIONS_INVALID", "shoot options", "the bytes are not shoot options",
                      "use programs of one version"});
  }
  ShootOptions options;
  options.method = static_cast<Method>(read.method);
  options.pyramids = {read.initial,
                      read.split,
                      read.depth,
                      read.alpha1,
                      read.alpha2,
                      static_cast<PyramidSampling>(read.sampling),
                      read.count_black != 0,
                      read.use_clusters != 0,
                      read.min_rays};
  if (absl::Status status = options.Validate(); !status.ok()) return status;
  return options;
}

}  // namespace lambert
