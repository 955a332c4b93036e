#include "radiosity/shoot/walk_flight.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "radiosity/core/error.h"

namespace lambert {
namespace {

// Rays one after the other that all go on, after which the flux is taken to have no way out: where
// one in a million is lost, not one in 1e13 such rows is by chance.
constexpr int64_t kRaysWithoutLoss = 30'000'000;

// Of a walk that begins: nothing of channels without flux, which else would keep it alive.
Double4 WholeShare(Long4 flux) {
  Double4 share;
  for (int c = 0; c < 4; ++c) share[c] = flux[c] != 0 ? 1 : 0;
  return share;
}

// Rounded to the nearest quantum.
Long4 Share(Long4 whole, Double4 share) {
  const Double4 left = Nearest(__builtin_convertvector(whole, Double4) * share);
  return __builtin_convertvector(left, Long4);
}

}  // namespace

void WalkFlight::Land() {
  if (!status().ok()) batch().size = 0;
  for (int k = 0; k < batch().size; ++k) {
    emitter_[k] = static_cast<uint32_t>(VisitOf(k).emitter);
    ray_[k] = RayOf(k);
    whole_[k] = FluxOf(k);
    share_[k] = WholeShare(whole_[k]);
  }
  RandomStream stream{unit_.seed, 0, 0, unit_.pass};  // its step is the bounce
  for (; batch().size > 0; ++stream.step) {
    const int rays = batch().size;
    Trace();
    LandTraced();
    const int left = Survive(rays, stream);
    rays_without_loss_ = left < rays ? 0 : rays_without_loss_ + left;
    if (rays_without_loss_ >= kRaysWithoutLoss) {
      Fail(MakeError(
          absl::StatusCode::kFailedPrecondition,
          {"SINGULAR_CLOSED_RHO_1", "scene",
           "light was reflected " + std::to_string(kRaysWithoutLoss) + " times without any loss",
           "give some material a reflectance under 1, or use --method pmcr"}));
      return;
    }
    for (int k = 0; k < left; ++k) SetFlux(k, Share(whole_[k], share_[k]), ray_[k]);
    for (int first = 0; first < left; first += 8) {
      const Onward& onward = onward_[first / 8];
      AppendCosineRays(emitters_.Frames(onward.at), onward.u, onward.v, onward.direction,
                       std::min(8, left - first), batch());
    }
  }
}

int WalkFlight::Survive(int rays, const RandomStream& stream) {
  RayNames8 names;
  RandomNumbers8 numbers;
  int left = 0;
  for (int k = 0; k < rays; ++k) {
    const int lane = k % 8;
    if (lane == 0) {
      // Slots after the last ray have names of walks before: their numbers are not used.
      std::memcpy(names.emitter, emitter_ + k, sizeof(names.emitter));
      std::memcpy(names.ray, ray_ + k, sizeof(names.ray));
      FillRandomNumbers(stream, names, numbers, RandomPurpose::kBounce, unit_.step);
    }
    const PatchIndex hit = batch().hit[k];
    if (hit < 0) continue;
    const Rgb& rho = reflectance_[hit];
    const Double4 reflected = share_[k] * Double4{rho.r, rho.g, rho.b, 0};
    const double survives = std::max({reflected[0], reflected[1], reflected[2]});
    // 48 bits: where little is lost, 24 would not tell how little.
    const double chance = static_cast<double>(numbers.numbers[0][lane]) +
                          static_cast<double>(numbers.numbers[1][lane]) * 0x1p-24;
    if (!(chance < survives)) continue;
    share_[left] = reflected / survives;
    share_[left][3] = 1;
    whole_[left] = whole_[k];
    emitter_[left] = emitter_[k];
    ray_[left] = ray_[k];
    Onward& onward = onward_[left / 8];
    onward.at[left % 8] = static_cast<uint32_t>(hit);
    onward.u[left % 8] = batch().hit_u[k];
    onward.v[left % 8] = batch().hit_v[k];
    onward.direction[0][left % 8] = numbers.numbers[2][lane];
    onward.direction[1][left % 8] = numbers.numbers[3][lane];
    ++left;
  }
  // The lanes after the last survivor must be valid.
  for (int k = left; k % 8 != 0; ++k) {
    Onward& onward = onward_[k / 8];
    onward.at[k % 8] = onward.at[0];
    onward.u[k % 8] = onward.v[k % 8] = onward.direction[0][k % 8] = onward.direction[1][k % 8] = 0;
  }
  return left;
}

}  // namespace lambert
