#include "radiosity/shoot/unit.h"

#include <algorithm>

#include "radiosity/core/bytes.h"
#include "radiosity/core/error.h"

namespace lambert {
namespace {

constexpr uint32_t kUnitMagic = 0x3455574C;    // "LWU4"
constexpr uint32_t kResultMagic = 0x3452554C;  // "LUR4"

struct UnitHeader {
  uint32_t magic = kUnitMagic;
  uint32_t visits = 0;
  uint64_t seed = 0;
  uint32_t pass = 0, step = 0;
  double rays_per_m2 = 0;
  uint32_t channels = 0, walks = 0;
};
static_assert(sizeof(UnitHeader) == 40);

struct VisitBytes {
  int32_t emitter;
  uint32_t ray_count, ray_begin, ray_end;
  uint32_t seen, reserved;  // quanta follow, and so many counts
};
static_assert(sizeof(VisitBytes) == 24);
constexpr uint32_t kMaxSeen = 65536;

struct ResultHeader {
  uint32_t magic = kResultMagic;
  uint32_t entries = 0;  // patches that were hit
  int64_t shot[3], escaped[3];
  int64_t rays = 0;
  uint64_t rests = 0, sightings = 0;
  uint32_t channels = 0, reserved = 0;
};
static_assert(sizeof(ResultHeader) == 88);

template <int kChannels>
struct DepositBytes {
  uint32_t patch, hits;
  int64_t quanta[kChannels];
};
static_assert(sizeof(DepositBytes<kColorChannels>) == 32);
static_assert(sizeof(DepositBytes<kGrayChannels>) == 16);

uint64_t QuantaBytes(uint32_t channels) { return channels * sizeof(int64_t); }
bool IsChannelCount(uint32_t n) { return n == kGrayChannels || n == kColorChannels; }
static_assert(sizeof(Sighting) == 16);

absl::Status Corrupt(const std::string& what, const std::string& why) {
  return MakeError(absl::StatusCode::kDataLoss,
                   {"RESULT_INVALID", what, why, "use programs of one version"});
}

// Modulo 2^64: defined for any numbers.
int64_t Sum(int64_t a, int64_t b) {
  return static_cast<int64_t>(static_cast<uint64_t>(a) + static_cast<uint64_t>(b));
}

void Add(const Quanta& from, Quanta& into) {
  for (int c = 0; c < 3; ++c) into[c] = Sum(into[c], from[c]);
}

// Two lists in the order of patches as one.
std::vector<Deposit> Merge(const std::vector<Deposit>& a, const std::vector<Deposit>& b) {
  std::vector<Deposit> merged;
  merged.reserve(a.size() + b.size());
  auto x = a.begin(), y = b.begin();
  while (x != a.end() && y != b.end()) {
    if (x->patch != y->patch) {
      merged.push_back(x->patch < y->patch ? *x++ : *y++);
      continue;
    }
    merged.push_back(
        {Sum(x->r, y->r), Sum(x->g, y->g), Sum(x->b, y->b), Sum(x->hits, y->hits), x->patch});
    ++x;
    ++y;
  }
  merged.insert(merged.end(), x, a.end());
  merged.insert(merged.end(), y, b.end());
  return merged;
}

template <int kChannels>
void Write(const std::vector<Deposit>& deposits, ByteWriter& writer) {
  for (const Deposit& d : deposits) {
    DepositBytes<kChannels> bytes{
        static_cast<uint32_t>(d.patch), static_cast<uint32_t>(d.hits), {d.r}};
    if constexpr (kChannels == kColorChannels) {
      bytes.quanta[1] = d.g;
      bytes.quanta[2] = d.b;
    }
    writer.Put(bytes);
  }
}

// False where they are out of order or not of places 0 .. place_count - 1. Requires: the bytes are
// there.
template <int kChannels>
bool Read(ByteReader& reader, uint64_t count, int64_t place_count, std::vector<Deposit>& deposits) {
  deposits.reserve(count);
  int64_t previous = -1;
  for (uint64_t k = 0; k < count; ++k) {
    DepositBytes<kChannels> d;
    reader.Get(&d);
    if (d.patch <= previous || d.patch >= place_count || d.hits == 0) return false;
    previous = d.patch;
    Deposit& read = deposits.emplace_back();
    read = {d.quanta[0], 0, 0, d.hits, static_cast<PatchIndex>(d.patch)};
    if constexpr (kChannels == kColorChannels) {
      read.g = d.quanta[1];
      read.b = d.quanta[2];
    }
  }
  return true;
}

std::array<int32_t, 3> Place(const Sighting& s) { return {s.emitter, s.cell, s.patch}; }

}  // namespace

void CombineSightings(std::vector<Sighting>& sightings) {
  std::sort(sightings.begin(), sightings.end(),
            [](const Sighting& a, const Sighting& b) { return Place(a) < Place(b); });
  size_t kept = 0;
  for (size_t k = 0; k < sightings.size(); ++k) {
    if (kept > 0 && Place(sightings[kept - 1]) == Place(sightings[k])) {
      Sighting& before = sightings[kept - 1];
      before.times = std::min(before.times + sightings[k].times, kManyTimes);
    } else {
      sightings[kept++] = sightings[k];
    }
  }
  sightings.resize(kept);
}

int64_t WorkUnit::RayCount() const {
  int64_t rays = 0;
  for (const Visit& visit : visits) rays += visit.ray_end - visit.ray_begin;
  return rays;
}

void MergeResult(const UnitResult& from, UnitResult& into) {
  into.deposits = Merge(from.deposits, into.deposits);
  into.rests = Merge(from.rests, into.rests);
  if (!from.sightings.empty()) {
    into.sightings.insert(into.sightings.end(), from.sightings.begin(), from.sightings.end());
    CombineSightings(into.sightings);
  }
  Add(from.shot, into.shot);
  Add(from.escaped, into.escaped);
  into.rays = Sum(into.rays, from.rays);
  if (from.rays != 0) into.channels = from.channels;
  into.cpu_seconds += from.cpu_seconds;
}

void SpreadGray(UnitResult& result) {
  for (std::vector<Deposit>* deposits : {&result.deposits, &result.rests}) {
    for (Deposit& d : *deposits) d.g = d.b = d.r;
  }
  result.shot.fill(result.shot[0]);
  result.escaped.fill(result.escaped[0]);
  result.channels = kColorChannels;
}

std::string EncodeUnit(const WorkUnit& unit) {
  ByteWriter writer;
  UnitHeader header;
  header.visits = static_cast<uint32_t>(unit.visits.size());
  header.seed = unit.seed;
  header.pass = unit.pass;
  header.step = unit.step;
  header.rays_per_m2 = unit.rays_per_m2;
  header.channels = static_cast<uint32_t>(unit.channels);
  header.walks = unit.walks ? 1 : 0;
  writer.Put(header);
  for (const Visit& v : unit.visits) {
    writer.Put(VisitBytes{v.emitter, v.ray_count, v.ray_begin, v.ray_end,
                          static_cast<uint32_t>(v.seen.size()), 0});
    writer.PutArray(v.quanta.data(), unit.channels);
    writer.PutArray(v.seen.data(), v.seen.size());
  }
  return writer.Take();
}

absl::StatusOr<WorkUnit> DecodeUnit(const std::string& bytes) {
  ByteReader reader(bytes);
  UnitHeader header;
  if (!reader.Get(&header) || header.magic != kUnitMagic || !IsChannelCount(header.channels) ||
      header.walks > 1 ||
      header.visits > reader.remaining() / (sizeof(VisitBytes) + QuantaBytes(header.channels))) {
    return Corrupt("work unit", "the bytes are not a work unit");
  }
  WorkUnit unit{header.seed,        header.pass,
                header.step,        {},
                header.rays_per_m2, static_cast<int>(header.channels),
                header.walks == 1};
  unit.visits.reserve(header.visits);
  for (uint32_t k = 0; k < header.visits; ++k) {
    VisitBytes v;
    Quanta quanta{};
    if (!reader.Get(&v) || v.reserved != 0 || v.seen > kMaxSeen ||
        !reader.GetArray(quanta.data(), unit.channels) ||
        v.seen > reader.remaining() / sizeof(uint32_t)) {
      return Corrupt("work unit", "the bytes are not a work unit");
    }
    std::vector<uint32_t> seen(v.seen);
    reader.GetArray(seen.data(), seen.size());
    unit.visits.push_back(
        {v.emitter, v.ray_count, v.ray_begin, v.ray_end, quanta, std::move(seen)});
  }
  if (!reader.Complete()) return Corrupt("work unit", "the bytes are not a work unit");
  return unit;
}

std::string EncodeUnitResult(const UnitResult& result) {
  ByteWriter writer;
  ResultHeader header;
  header.entries = static_cast<uint32_t>(result.deposits.size());
  std::copy(result.shot.begin(), result.shot.end(), header.shot);
  std::copy(result.escaped.begin(), result.escaped.end(), header.escaped);
  header.rays = result.rays;
  header.rests = result.rests.size();
  header.sightings = result.sightings.size();
  header.channels = static_cast<uint32_t>(result.channels);
  writer.Put(header);
  for (const std::vector<Deposit>* deposits : {&result.deposits, &result.rests}) {
    if (result.channels == kGrayChannels) {
      Write<kGrayChannels>(*deposits, writer);
    } else {
      Write<kColorChannels>(*deposits, writer);
    }
  }
  writer.PutArray(result.sightings.data(), result.sightings.size());
  return writer.Take();
}

absl::StatusOr<UnitResult> DecodeUnitResult(const std::string& bytes, PatchIndex patch_count) {
  ByteReader reader(bytes);
  ResultHeader header;
  if (!reader.Get(&header) || header.magic != kResultMagic || !IsChannelCount(header.channels) ||
      header.reserved != 0) {
    return Corrupt("unit result", "the bytes are not a unit's result");
  }
  const bool gray = header.channels == kGrayChannels;
  const uint64_t deposit_bytes =
      gray ? sizeof(DepositBytes<kGrayChannels>) : sizeof(DepositBytes<kColorChannels>);
  if (header.rests > reader.remaining() / deposit_bytes ||
      header.sightings > reader.remaining() / sizeof(Sighting) ||
      reader.remaining() !=
          (header.entries + header.rests) * deposit_bytes + header.sightings * sizeof(Sighting)) {
    return Corrupt("unit result", "the bytes are not a unit's result");
  }
  UnitResult result;
  std::copy(std::begin(header.shot), std::end(header.shot), result.shot.begin());
  std::copy(std::begin(header.escaped), std::end(header.escaped), result.escaped.begin());
  result.rays = header.rays;
  result.channels = static_cast<int>(header.channels);
  // A tree over N patches has fewer than N elements.
  const auto read = gray ? Read<kGrayChannels> : Read<kColorChannels>;
  if (!read(reader, header.entries, patch_count, result.deposits) ||
      !read(reader, header.rests, 2 * int64_t{patch_count}, result.rests)) {
    return Corrupt("unit result", "its patches are out of order or out of range");
  }
  result.sightings.resize(header.sightings);
  reader.GetArray(result.sightings.data(), result.sightings.size());
  std::array<int32_t, 3> last{-1, -1, -1};
  for (const Sighting& seen : result.sightings) {
    if (Place(seen) <= last || seen.emitter < 0 || seen.emitter >= patch_count || seen.cell < 0 ||
        seen.cell >= static_cast<int32_t>(kMaxSeen) || seen.patch < 0 ||
        seen.patch >= patch_count || seen.times < 1 || seen.times > kManyTimes) {
      return Corrupt("unit result", "its sightings are out of order or out of range");
    }
    last = Place(seen);
  }
  return result;
}

}  // namespace lambert
