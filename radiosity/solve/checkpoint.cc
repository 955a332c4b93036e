#include "radiosity/solve/checkpoint.h"

#include <utility>

#include "radiosity/core/bytes.h"
#include "radiosity/core/error.h"

namespace lambert {
namespace {

constexpr uint32_t kMagic = 0x3253534C;  // "LSS2"

struct Header {
  uint32_t magic = kMagic, reserved = 0;
  RunState state;
  uint64_t replicates_bytes = 0;  // follow; the sightings come after
};

}  // namespace

std::string EncodeCheckpoint(const RunState& state, const Replicates& replicates,
                             const SightingTable& sightings) {
  const std::string found = replicates.Encode(), seen = sightings.Encode();
  ByteWriter writer;
  writer.Put(Header{kMagic, 0, state, found.size()});
  writer.PutArray(found.data(), found.size());
  writer.PutArray(seen.data(), seen.size());
  return writer.Take();
}

absl::Status RestoreCheckpoint(const std::string& bytes, RunState& state, Replicates& replicates,
                               SightingTable& sightings) {
  ByteReader reader(bytes);
  Header header;
  if (!reader.Get(&header) || header.magic != kMagic ||
      header.replicates_bytes > reader.remaining()) {
    return MakeError(absl::StatusCode::kDataLoss,
                     {"CHECKPOINT_INVALID", "checkpoint", "the bytes are not a checkpoint",
                      "start the job again"});
  }
  SightingTable seen;
  absl::Status status = seen.Restore(bytes.substr(sizeof(header) + header.replicates_bytes));
  if (!status.ok()) return status;
  status = replicates.Restore(bytes.substr(sizeof(header), header.replicates_bytes));
  if (!status.ok()) return status;
  state = header.state;
  sightings = std::move(seen);
  return absl::OkStatus();
}

}  // namespace lambert
