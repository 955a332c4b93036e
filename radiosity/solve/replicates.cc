#include "radiosity/solve/replicates.h"

#include <cmath>

#include "radiosity/core/bytes.h"
#include "radiosity/core/error.h"

namespace lambert {
namespace {

constexpr uint32_t kMagic = 0x3152504C;  // "LPR1"
constexpr size_t kBytesPerPatch = 2 * sizeof(Rgb) + sizeof(double) + sizeof(int64_t);

struct Header {
  uint32_t magic = kMagic;
  int32_t passes = 0;
  int64_t patches = 0;
  double weight = 0;
  Ledger ledger;
};

void Blend(const Rgb& value, double share, Rgb& mean) { mean = mean + (value - mean) * share; }

}  // namespace

Replicates::Replicates(const PatchSet& patches, bool hits_are_rays)
    : patches_(patches),
      hits_are_rays_(hits_are_rays),
      irradiance_lx_(patches.size()),
      spread_(patches.size()),
      gray_spread_(patches.size()),
      hits_(patches.size()) {}

void Replicates::Add(const FluxLedger& pass, int64_t rays) {
  const double weight = static_cast<double>(rays);
  const double share = weight / (weight_ + weight);
  const std::vector<Rgb> arrived_lm = pass.ArrivedFlux();
  for (PatchIndex i = 0; i < patches_.size(); ++i) {
    const Rgb irradiance = arrived_lm[i] / patches_.area_m2[i];
    // West's update: the spread grows by N_p W / (W + N_p) (x_p - x)^2 with W the weight before.
    const Rgb delta = patches_.reflectance[i] * (irradiance - irradiance_lx_[i]);
    const double gray = lambert::Mean(delta);
    spread_[i] = spread_[i] + delta * delta * (weight_ * share);
    gray_spread_[i] += gray * gray * (weight_ * share);
    Blend(irradiance, share, irradiance_lx_[i]);
    hits_[i] += pass.hits()[i];
  }
  const Ledger balance = pass.Balance();
  ledger_.emitted = balance.emitted;
  Blend(balance.absorbed, share, ledger_.absorbed);
  Blend(balance.escaped, share, ledger_.escaped);
  Blend(balance.unsent, share, ledger_.unsent);
  Blend(balance.residual, share, ledger_.residual);
  weight_ += weight;
  ++passes_;
}

// What a ray carries in the mean solution [lm], whether it arrived or not.
Rgb Replicates::MeanFluxOfRay() const {
  CompensatedSum flux[3];
  for (PatchIndex i = 0; i < patches_.size(); ++i) {
    for (int c = 0; c < 3; ++c) flux[c].Add(irradiance_lx_[i][c] * patches_.area_m2[i]);
  }
  const Rgb arrived{flux[0].value(), flux[1].value(), flux[2].value()};
  return (arrived + ledger_.escaped) / weight_;
}

Solution Replicates::Mean() const {
  Solution solution;
  solution.irradiance_lx = irradiance_lx_;
  solution.hits = hits_;
  solution.ledger = ledger_;
  solution.radiosity_lm_per_m2.resize(patches_.size());
  // One pass does not tell how far it is off.
  solution.std_error_lm_per_m2.resize(patches_.size(), passes_ == 1 ? kUnknownError : Rgb{});
  const double scale = passes_ > 1 ? 1 / ((passes_ - 1) * weight_) : 0;
  const Rgb flux_of_ray = hits_are_rays_ && passes_ > 1 ? MeanFluxOfRay() : Rgb{};
  for (PatchIndex i = 0; i < patches_.size(); ++i) {
    solution.radiosity_lm_per_m2[i] =
        patches_.exitance_lm_per_m2[i] + patches_.reflectance[i] * irradiance_lx_[i];
    if (passes_ < 2) continue;
    if (hits_[i] == 0 && irradiance_lx_[i] == Rgb{}) {
      solution.std_error_lm_per_m2[i] = patches_.reflectance[i] * flux_of_ray / patches_.area_m2[i];
      continue;
    }
    for (int c = 0; c < 3; ++c) {
      solution.std_error_lm_per_m2[i][c] = std::sqrt(spread_[i][c] * scale);
    }
  }
  return solution;
}

double Replicates::EstimatedRms(bool by_area) const {
  if (passes_ < 2) return -1;
  CompensatedSum area, reflected, variance, weights;
  for (PatchIndex i = 0; i < patches_.size(); ++i) {
    const double a = patches_.area_m2[i], w = by_area ? a : 1;
    area.Add(a);
    reflected.Add(a * lambert::Mean(patches_.reflectance[i] * irradiance_lx_[i]));
    weights.Add(w);
    variance.Add(w * gray_spread_[i]);
  }
  if (!(reflected.value() > 0)) return 0;
  const double mean_variance = variance.value() / weights.value() / ((passes_ - 1) * weight_);
  return std::sqrt(mean_variance) / (reflected.value() / area.value());
}

std::string Replicates::Encode() const {
  ByteWriter writer;
  writer.Put(Header{kMagic, passes_, patches_.size(), weight_, ledger_});
  writer.PutArray(irradiance_lx_.data(), irradiance_lx_.size());
  writer.PutArray(spread_.data(), spread_.size());
  writer.PutArray(gray_spread_.data(), gray_spread_.size());
  writer.PutArray(hits_.data(), hits_.size());
  return writer.Take();
}

absl::Status Replicates::Restore(const std::string& bytes) {
  ByteReader reader(bytes);
  Header header;
  if (!reader.Get(&header) || header.magic != kMagic || header.passes < 0 ||
      header.patches != patches_.size() || reader.remaining() != hits_.size() * kBytesPerPatch) {
    return MakeError(absl::StatusCode::kDataLoss,
                     {"CHECKPOINT_INVALID", "checkpoint", "it does not belong to this patch set",
                      "start the job again"});
  }
  reader.GetArray(irradiance_lx_.data(), irradiance_lx_.size());
  reader.GetArray(spread_.data(), spread_.size());
  reader.GetArray(gray_spread_.data(), gray_spread_.size());
  reader.GetArray(hits_.data(), hits_.size());
  passes_ = header.passes;
  weight_ = header.weight;
  ledger_ = header.ledger;
  return absl::OkStatus();
}

}  // namespace lambert
