#include "radiosity/solve/sightings.h"

#include <algorithm>
#include <cmath>
#include <roaring/roaring64map.hh>

#include "radiosity/core/bytes.h"
#include "radiosity/core/error.h"

namespace lambert {
namespace {

constexpr uint32_t kMagic = 0x3154534C;  // "LST1"

uint64_t Key(int32_t cell, PatchIndex patch) {
  return static_cast<uint64_t>(cell) << 32 | static_cast<uint32_t>(patch);
}

}  // namespace

struct SightingTable::OfEmitter {
  // Seen at least k + 1 times; of a cell: its keys have the cell in their upper half.
  Roaring64Map at_least[kManyTimes];

  int32_t Times(uint64_t key) const {
    int32_t times = 0;
    while (times < kManyTimes && at_least[times].contains(key)) ++times;
    return times;
  }
  uint64_t Count(int level, int32_t cell) const {
    const uint64_t first = Key(cell, 0), last = first | 0xFFFFFFFFu;
    const uint64_t before = first == 0 ? 0 : at_least[level].rank(first - 1);
    return at_least[level].rank(last) - before;
  }
};

SightingTable::SightingTable() = default;
SightingTable::~SightingTable() = default;
SightingTable& SightingTable::operator=(SightingTable&&) = default;

void SightingTable::Add(const std::vector<Sighting>& sightings) {
  for (const Sighting& seen : sightings) {
    OfEmitter& of = emitters_[seen.emitter];
    const uint64_t key = Key(seen.cell, seen.patch);
    const int32_t before = of.Times(key);
    const int32_t after = std::min(before + seen.times, kManyTimes);
    for (int32_t level = before; level < after; ++level) of.at_least[level].add(key);
  }
}

std::vector<uint32_t> SightingTable::Counts(int32_t emitter, int cells, bool unseen) const {
  const auto found = emitters_.find(emitter);
  if (found == emitters_.end()) return {};
  std::vector<uint32_t> counts(cells);
  for (int32_t cell = 0; cell < cells; ++cell) {
    const auto seen = static_cast<double>(found->second.Count(0, cell));
    double hidden = 0;
    if (unseen) {
      const auto twice = static_cast<double>(found->second.Count(1, cell));
      const auto often = static_cast<double>(found->second.Count(2, cell));
      const double f1 = seen - twice, f2 = twice - often;
      hidden = f1 * (f1 - 1) / (2 * (f2 + 1));
    }
    counts[cell] = static_cast<uint32_t>(std::min(std::round(seen + hidden), 4e9));
  }
  return counts;
}

std::string SightingTable::Encode() const {
  ByteWriter writer;
  writer.Put(kMagic);
  uint64_t count = 0;
  for (const auto& [emitter, of] : emitters_) count += of.at_least[0].cardinality();
  writer.Put(count);
  for (const auto& [emitter, of] : emitters_) {
    for (const uint64_t key : of.at_least[0]) {
      writer.Put(Sighting{emitter, static_cast<int32_t>(key >> 32),
                          static_cast<PatchIndex>(key & 0xFFFFFFFFu), of.Times(key)});
    }
  }
  return writer.Take();
}

absl::Status SightingTable::Restore(const std::string& bytes) {
  emitters_.clear();
  ByteReader reader(bytes);
  uint32_t magic = 0;
  uint64_t count = 0;
  const bool headed = reader.Get(&magic) && magic == kMagic && reader.Get(&count) &&
                      count <= reader.remaining() / sizeof(Sighting);
  std::vector<Sighting> sightings(headed ? count : 0);
  reader.GetArray(sightings.data(), sightings.size());
  bool valid = headed && reader.Complete();
  for (const Sighting& seen : sightings) {
    valid = valid && seen.emitter >= 0 && seen.cell >= 0 && seen.patch >= 0 && seen.times >= 1 &&
            seen.times <= kManyTimes;
  }
  if (!valid) {
    return MakeError(
        absl::StatusCode::kDataLoss,
        {"CHECKPOINT_INVALID", "checkpoint", "its sightings are damaged", "start the job again"});
  }
  Add(sightings);
  return absl::OkStatus();
}

}  // namespace lambert
