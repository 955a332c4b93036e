#include "radiosity/solve/solution.h"

#include "radiosity/core/bytes.h"
#include "radiosity/core/error.h"

namespace lambert {
namespace {

constexpr uint32_t kMagic = 0x3153434C;  // "LCS1"
constexpr size_t kBytesPerPatch = 3 * sizeof(Rgb) + sizeof(int64_t);

struct Header {
  uint32_t magic = kMagic;
  uint32_t patches = 0;
  Ledger ledger;
};

}  // namespace

std::string EncodeSolution(const Solution& solution) {
  ByteWriter writer;
  const size_t n = solution.radiosity_lm_per_m2.size();
  writer.Put(Header{kMagic, static_cast<uint32_t>(n), solution.ledger});
  writer.PutArray(solution.radiosity_lm_per_m2.data(), n);
  writer.PutArray(solution.irradiance_lx.data(), n);
  writer.PutArray(solution.std_error_lm_per_m2.data(), n);
  writer.PutArray(solution.hits.data(), n);
  return writer.Take();
}

absl::StatusOr<Solution> DecodeSolution(const std::string& bytes) {
  ByteReader reader(bytes);
  Header header;
  if (!reader.Get(&header) || header.magic != kMagic ||
      reader.remaining() != header.patches * kBytesPerPatch) {
    return MakeError(absl::StatusCode::kDataLoss,
                     {"SOLUTION_INVALID", "solution", "the bytes are not a solution",
                      "fetch it again with a client of the server's version"});
  }
  Solution solution;
  solution.ledger = header.ledger;
  solution.radiosity_lm_per_m2.resize(header.patches);
  solution.irradiance_lx.resize(header.patches);
  solution.std_error_lm_per_m2.resize(header.patches);
  solution.hits.resize(header.patches);
  reader.GetArray(solution.radiosity_lm_per_m2.data(), header.patches);
  reader.GetArray(solution.irradiance_lx.data(), header.patches);
  reader.GetArray(solution.std_error_lm_per_m2.data(), header.patches);
  reader.GetArray(solution.hits.data(), header.patches);
  return solution;
}

}  // namespace lambert
