#include "radiosity/solve/ambient.h"

#include <algorithm>
#include <cmath>

namespace lambert {
namespace {

constexpr double kStiffLoss = 0.01;       // at a bounce: under it over a thousand bounces
constexpr int64_t kRaysToBelieve = 100;   // before anything is shot ahead
constexpr double kRaysToLearn = 500;      // of a group's first step
constexpr double kRaysOfSolution = 1000;  // that a group gets at least,
constexpr double kRaysPerNoiseRay = 10;   // and this many times its NoiseRays
constexpr double kNoiseRaysLeft = 3;
constexpr double kGrowth = 8;  // of what was shot in a group, from step to step, while not sure
constexpr double kRaysOfGuess = 10;  // what the guess of a group's loss counts for
constexpr int64_t kRaysWithoutLoss = 1'000'000;
constexpr double kLeftPerRootRay = 0.1;
constexpr double kRoundedToZero = 1e-13;

double Magnitude(const Rgb& flux) { return ChannelSum(Abs(flux)); }

double Least(const Rgb& value) { return std::min({value.r, value.g, value.b}); }

}  // namespace

Ambient::Ambient(const PatchSet& patches, const std::vector<int32_t>& group_of,
                 const Before& before, const RayFlux& ray_flux)
    : patches_(patches), group_of_(group_of), ray_flux_(ray_flux) {
  groups_.resize(1 + *std::max_element(group_of.begin(), group_of.end()));
  for (PatchIndex i = 0; i < patches.size(); ++i) groups_[group_of[i]].members.push_back(i);
  GuessFromMaterials();
  // The flux of lights enters groups that are not known.
  if (!before.flux_lm.empty() && patches.lights.empty()) GuessFromSolution(before);
}

// If the group is closed and its irradiance uniform.
void Ambient::GuessFromMaterials() {
  std::vector<double> area_m2(groups_.size());
  for (PatchIndex i = 0; i < patches_.size(); ++i) {
    Group& group = groups_[group_of_[i]];
    area_m2[group_of_[i]] += patches_.area_m2[i];
    group.shape_lm = group.shape_lm + patches_.reflectance[i] * patches_.area_m2[i];
    const Rgb kept = Rgb{1, 1, 1} - patches_.reflectance[i];
    group.guess = group.guess + kept * patches_.area_m2[i];
  }
  for (size_t g = 0; g < groups_.size(); ++g) {
    groups_[g].guess = groups_[g].guess / area_m2[g];
    groups_[g].guess_rays = kRaysOfGuess;
  }
}

// As much is lost as is emitted.
void Ambient::GuessFromSolution(const Before& before) {
  std::vector<Rgb> emitted(groups_.size()), leaving(groups_.size());
  double all = 0;
  for (PatchIndex i = 0; i < patches_.size(); ++i) {
    const int32_t g = group_of_[i];
    emitted[g] = emitted[g] + patches_.exitance_lm_per_m2[i] * patches_.area_m2[i];
    leaving[g] = leaving[g] + before.flux_lm[i];
    all += Magnitude(before.flux_lm[i]);
  }
  for (size_t g = 0; g < groups_.size(); ++g) {
    for (int c = 0; c < 3; ++c) {
      if (!(emitted[g][c] > 0) || !(leaving[g][c] > emitted[g][c])) continue;
      groups_[g].guess[c] = emitted[g][c] / leaving[g][c];
    }
    const double rays = static_cast<double>(before.rays) * Magnitude(leaving[g]) / all;
    groups_[g].guess_rays = std::max(kRaysOfGuess, rays);
  }
}

Rgb Ambient::LossOf(const Group& group) const {
  Rgb loss;
  const double rays = static_cast<double>(group.rays);
  for (int c = 0; c < 3; ++c) {
    const double seen = group.shot[c] > 0 ? group.lost[c] / group.shot[c] : 0;
    loss[c] = (seen * rays + group.guess[c] * group.guess_rays) / (rays + group.guess_rays);
    // No loss at all in n rays: about one in n at most.
    if (loss[c] <= kRoundedToZero) loss[c] = 1 / (rays + group.guess_rays);
  }
  return loss;
}

bool Ambient::IsStiff(const Group& group) const {
  return Least(group.rays < kRaysToBelieve ? group.guess : LossOf(group)) < kStiffLoss;
}

bool Ambient::Helps() const {
  return std::any_of(groups_.begin(), groups_.end(),
                     [this](const Group& group) { return IsStiff(group); });
}

std::vector<bool> Ambient::StiffGroups() const {
  std::vector<bool> stiff(groups_.size());
  for (size_t g = 0; g < groups_.size(); ++g) stiff[g] = IsStiff(groups_[g]);
  return stiff;
}

int32_t Ambient::StiffGroupOf(int32_t emitter, const std::vector<bool>& stiff) const {
  const int32_t group = emitter < patches_.size() ? group_of_[emitter] : kNoGroup;
  return group != kNoGroup && stiff[group] ? group : kNoGroup;
}

std::vector<Ambient::Unsent> Ambient::SumByGroup(const std::vector<UnsentFlux>& flux) const {
  const std::vector<bool> stiff_groups = StiffGroups();
  std::vector<CompensatedSum> sums(3 * groups_.size() + 3);
  std::vector<Unsent> by_group(groups_.size() + 1);
  for (const auto& [emitter, lm] : flux) {
    const int32_t stiff = StiffGroupOf(emitter, stiff_groups);
    const size_t group = stiff == kNoGroup ? groups_.size() : stiff;
    for (int c = 0; c < 3; ++c) sums[3 * group + c].Add(lm[c]);
    by_group[group].magnitude += Magnitude(lm);
  }
  for (size_t k = 0; k < sums.size(); ++k) {
    by_group[k / 3].sum[static_cast<int>(k % 3)] = sums[k].value();
  }
  return by_group;
}

std::vector<Rgb> Ambient::AheadByGroup(const std::vector<Unsent>& unsent) const {
  std::vector<Rgb> ahead(groups_.size());
  for (size_t g = 0; g < groups_.size(); ++g) {
    if (groups_[g].rays < kRaysToBelieve || !IsStiff(groups_[g])) continue;
    const Rgb loss = LossOf(groups_[g]);
    const bool sure = IsSure(groups_[g]);
    for (int c = 0; c < 3; ++c) {
      const double due = unsent[g].sum[c];
      const double most = kGrowth * std::max(groups_[g].shot[c], std::fabs(due));
      ahead[g][c] = due * (1 - loss[c]) / loss[c];
      if (!sure) ahead[g][c] = std::clamp(ahead[g][c], -most, most);
    }
  }
  return ahead;
}

void Ambient::Spread(const Group& group, Rgb sum, std::vector<UnsentFlux>& flux) const {
  if (sum == Rgb{}) return;
  for (PatchIndex i : group.members) {
    Rgb share;
    for (int c = 0; c < 3; ++c) {
      if (sum[c] == 0 || !(group.shape_lm[c] > 0)) continue;
      share[c] = sum[c] * (patches_.reflectance[i][c] * patches_.area_m2[i] / group.shape_lm[c]);
    }
    if (share != Rgb{}) flux.push_back({i, share});
  }
}

std::vector<UnsentFlux> Ambient::Ahead(const FluxLedger& ledger) {
  const std::vector<Unsent> unsent = SumByGroup(ledger.unsent());
  const std::vector<Rgb> ahead = AheadByGroup(unsent);
  const auto lit = static_cast<double>(
      std::count_if(ahead.begin(), ahead.end(), [](const Rgb& flux) { return flux != Rgb{}; }));
  for (size_t g = 0; g < groups_.size(); ++g) {
    if (ahead[g] == Rgb{}) continue;
    const double flux_lm = unsent[g].magnitude + Magnitude(ahead[g]);
    ChooseFluxPerRay(flux_lm, ray_flux_.least_rays / lit, groups_[g]);
  }
  std::vector<UnsentFlux> flux;
  for (size_t g = 0; g < groups_.size(); ++g) Spread(groups_[g], ahead[g], flux);
  if (lit > 1) std::ranges::sort(flux, {}, &UnsentFlux::emitter);
  return flux;
}

void Ambient::ChooseFluxPerRay(double flux_lm, double least_rays, Group& group) const {
  if (group.chosen) return;
  group.chosen = IsSure(group);
  // Sure, what is shot now is about the whole solution; not sure, it is to learn from.
  const double rays =
      group.chosen ? std::max({least_rays, kRaysOfSolution, kRaysPerNoiseRay * NoiseRays(group)})
                   : kGrowth * static_cast<double>(group.rays);
  group.flux_per_ray_lm = std::min(ray_flux_.stiff_lm, flux_lm / rays);
}

bool Ambient::IsSure(const Group& group) const {
  return static_cast<double>(group.rays) + group.guess_rays >= kRaysPerNoiseRay * NoiseRays(group);
}

double Ambient::NoiseRays(const Group& group) const {
  const Rgb loss = LossOf(group);
  const double rays = static_cast<double>(std::max<int64_t>(1, group.rays));
  double most = 0;
  for (int c = 0; c < 3; ++c) {
    const double mean = group.losses[c] / rays;
    // Of a ray that loses all or nothing, where none has lost anything yet.
    const double variance =
        mean > kRoundedToZero ? group.squared_losses[c] / rays - mean * mean : loss[c];
    most = std::max(most, variance / (loss[c] * loss[c]));
  }
  return most;
}

std::vector<Ambient::Part> Ambient::Divide(const std::vector<UnsentFlux>& unsent) const {
  const std::vector<bool> stiff_groups = StiffGroups();
  std::vector<Part> by_group(groups_.size() + 1);
  for (const UnsentFlux& flux : unsent) {
    const int32_t group = StiffGroupOf(flux.emitter, stiff_groups);
    Part& part = by_group[group == kNoGroup ? groups_.size() : group];
    part.group = group;
    part.unsent.push_back(flux);
  }
  std::erase_if(by_group, [](const Part& part) { return part.unsent.empty(); });
  for (Part& part : by_group) {
    if (part.group == kNoGroup) {
      part.flux_per_ray_lm = ray_flux_.elsewhere_lm;
      continue;
    }
    const Group& group = groups_[part.group];
    part.flux_per_ray_lm = group.flux_per_ray_lm;
    if (group.flux_per_ray_lm > 0) continue;
    double flux = 0;
    for (const UnsentFlux& one : part.unsent) flux += Magnitude(one.flux_lm);
    part.flux_per_ray_lm = std::min(ray_flux_.stiff_lm, flux / kRaysToLearn);
  }
  return by_group;
}

std::vector<UnsentFlux> Ambient::Learn(int32_t of_group, const std::vector<UnsentFlux>& sent,
                                       const StepPlan& plan, const UnitResult& result) {
  if (of_group == kNoGroup) return {};
  Group& group = groups_[of_group];
  const Rgb shot = InLumen(result.shot, plan.quantum_lm);
  CompensatedSum lost[3], kept[3];
  for (int c = 0; c < 3; ++c) {
    lost[c].Add(shot[c]);
    kept[c].Add(-shot[c]);
    for (const UnsentFlux& flux : sent) kept[c].Add(flux.flux_lm[c]);
  }
  int64_t escaped = result.rays;
  for (const Deposit& d : result.deposits) {
    escaped -= d.hits;
    const Rgb loss = Rgb{1, 1, 1} - patches_.reflectance[d.patch];
    group.losses = group.losses + loss * static_cast<double>(d.hits);
    group.squared_losses = group.squared_losses + loss * loss * static_cast<double>(d.hits);
    const Rgb reflected = patches_.reflectance[d.patch] * InLumen(d.quanta(), plan.quantum_lm);
    for (int c = 0; c < 3; ++c) lost[c].Add(-reflected[c]);
  }
  const Rgb gone = Rgb{1, 1, 1} * static_cast<double>(escaped);
  group.losses = group.losses + gone;
  group.squared_losses = group.squared_losses + gone;
  group.shot = group.shot + shot;
  group.rays += result.rays;
  for (int c = 0; c < 3; ++c) group.lost[c] += lost[c].value();
  std::vector<UnsentFlux> rest;
  Spread(group, {kept[0].value(), kept[1].value(), kept[2].value()}, rest);
  return rest;
}

double Ambient::Left(const FluxLedger& ledger) const {
  const std::vector<Unsent> unsent = SumByGroup(ledger.unsent());
  const std::vector<Rgb> ahead = AheadByGroup(unsent);
  double most = 0;
  for (size_t g = 0; g < groups_.size(); ++g) {
    const double left = unsent[g].magnitude + Magnitude(ahead[g]);
    const double shot = Magnitude(groups_[g].shot);
    if (left > 0) most = std::max(most, shot > 0 ? std::min(1.0, left / shot) : 1);
  }
  return most;
}

bool Ambient::IsDone(const FluxLedger& ledger, double elsewhere_lm) const {
  const std::vector<Unsent> unsent = SumByGroup(ledger.unsent());
  const std::vector<Rgb> ahead = AheadByGroup(unsent);
  for (size_t g = 0; g < groups_.size(); ++g) {
    const Group& group = groups_[g];
    const double shot = Magnitude(group.shot);
    const double left = unsent[g].magnitude + Magnitude(ahead[g]);
    if (left > 0 && !IsSure(group)) return false;
    const double noise = kNoiseRaysLeft * NoiseRays(group) * group.flux_per_ray_lm;
    const double tolerance =
        kLeftPerRootRay * shot / std::sqrt(1.0 + static_cast<double>(group.rays));
    if (left > std::max(tolerance, noise)) return false;
  }
  return unsent.back().magnitude <= elsewhere_lm;
}

bool Ambient::LosesNothing() const {
  for (const Group& group : groups_) {
    if (group.rays < kRaysWithoutLoss) continue;
    for (int c = 0; c < 3; ++c) {
      if (group.shot[c] > 0 && group.lost[c] <= kRoundedToZero * group.shot[c]) return true;
    }
  }
  return false;
}

}  // namespace lambert
