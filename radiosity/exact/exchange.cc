#include "radiosity/exact/exchange.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "radiosity/exact/closure.h"
#include "radiosity/exact/occluders.h"
#include "radiosity/patch/light.h"

namespace lambert {
namespace {

constexpr int kPilotSamples = 16;
// Standard deviation, as a share of the whole, of a link whose pilot saw no difference: few of them
// are mixed, but there are many.
constexpr double kLeastSpread = 0.03;
// The same of a pair that all but touches: what is blocked there may weigh many times the whole.
constexpr double kLeastSpreadNear = 0.3;

// The numbers of one link: the same for all its samples.
std::array<float, 4> Shift(const Link& link, uint64_t seed, uint32_t pass, RandomPurpose purpose) {
  return RandomNumbers({seed, static_cast<uint32_t>(link.j), static_cast<uint32_t>(link.i), pass},
                       0, purpose);
}

// Control and spread of a link from its pilot's samples.
void SetGuess(const std::vector<Segments::Segment>& segments, const std::vector<bool>& visible,
              bool near, double whole, Link& link) {
  double seen = 0, all = 0;
  for (size_t k = 0; k < segments.size(); ++k) {
    all += segments[k].weight;
    if (visible[k]) seen += segments[k].weight;
  }
  // Weights that have no bound must not be sampled where the parts meet: those are visible.
  link.control = static_cast<float>(near && seen > 0 ? 1 : all > 0 ? seen / all : 0);
  double squares = 0;
  for (size_t k = 0; k < segments.size(); ++k) {
    const double deviation = segments[k].weight * ((visible[k] ? 1 : 0) - link.control);
    squares += deviation * deviation;
  }
  const double least = (near ? kLeastSpreadNear : kLeastSpread) * whole;
  link.spread =
      static_cast<float>(std::sqrt(squares / static_cast<double>(segments.size()) + least * least));
}

}  // namespace

Exchange::Exchange(const PatchSet& patches, const RayScene& scene, bool may_hide)
    : patches_(patches),
      scene_(scene),
      is_closed_(may_hide && IsClosed(patches, scene)),
      unoccluded_{ExchangeMatrix(patches.size()),
                  LightFractions(patches.lights.size(), std::vector<double>(patches.size()))} {
  const std::optional<Occluders> occluders =
      may_hide ? std::optional<Occluders>(patches) : std::nullopt;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    for (PatchIndex j = i + 1; j < patches.size(); ++j) {
      const Facing facing = FacingParts(patches.corners[i], patches.corners[j]);
      const double whole = ExchangeArea(facing);
      if (whole == 0) continue;
      unoccluded_.exchange.at(i, j) = whole;
      if (may_hide && !occluders->SurelyClear(facing.from, facing.to)) links_.push_back({i, j});
    }
  }
  AddLights(may_hide);
  RunPilot();
}

void Exchange::AddLights(bool may_hide) {
  for (int l = 0; l < LightCount(patches_); ++l) lights_.emplace_back(patches_, l);
  for (size_t l = 0; l < lights_.size(); ++l) {
    for (PatchIndex i = 0; i < patches_.size(); ++i) {
      const double fraction = lights_[l].Of(patches_.corners[i]);
      if (fraction == 0) continue;
      unoccluded_.lights[l][i] = fraction;
      if (may_hide) links_.push_back({i, patches_.size() + static_cast<PatchIndex>(l)});
    }
  }
}

Segments Exchange::SegmentsOf(const Link& link) const {
  const Triangle& at = patches_.corners[link.i];
  if (link.j < patches_.size()) return Segments(FacingParts(at, patches_.corners[link.j]));
  return Segments(lights_[link.j - patches_.size()], at);
}

double& Exchange::Entry(const Link& link, Transport& transport) {
  const PatchIndex patches = transport.exchange.size();
  return link.j < patches ? transport.exchange.at(link.i, link.j)
                          : transport.lights[link.j - patches][link.i];
}

void Exchange::RunPilot() {
  SegmentTracer tracer(scene_);
  std::vector<Segments::Segment> segments(kPilotSamples);
  std::vector<bool> visible(kPilotSamples);
  for (Link& link : links_) {
    const Segments source = SegmentsOf(link);
    const auto shift = Shift(link, 0, 0, RandomPurpose::kPilot);
    for (int k = 0; k < kPilotSamples; ++k) {
      segments[k] = source.Sample(shift, k);
      tracer.Add(segments[k].from, source.from_normal(), segments[k].to, source.to_normal());
    }
    tracer.Land([&](int k, bool is_visible) { visible[k] = is_visible; });
    SetGuess(segments, visible, source.near(), Entry(link, unoccluded_), link);
  }
}

Transport Exchange::Guess() const {
  Transport transport = unoccluded_;
  for (const Link& link : links_) Entry(link, transport) *= link.control;
  if (is_closed_) transport.exchange.CloseRows(patches_.area_m2);
  return transport;
}

Transport Exchange::Sample(const std::vector<double>& weights, int64_t rays, uint64_t seed,
                           uint32_t pass) const {
  Transport transport = Guess();
  double total = 0;
  for (double weight : weights) total += weight;
  struct Pending {
    const Link* link;
    double share;  // of the link, times the weight
  };
  std::vector<Pending> pending;
  SegmentTracer tracer(scene_);
  const auto land = [&] {
    tracer.Land([&](int k, bool is_visible) {
      const Pending& p = pending[k];
      Entry(*p.link, transport) += p.share * ((is_visible ? 1 : 0) - p.link->control);
    });
    pending.clear();
  };
  double cumulative = RandomNumbers({seed, 0, 0, pass}, 0, RandomPurpose::kPatchOffset)[0];
  double dealt = 0;
  for (size_t l = 0; l < links_.size(); ++l) {
    const double expected = weights[l] / total * static_cast<double>(rays);
    cumulative += expected;
    const double count = std::floor(cumulative) - dealt;
    dealt += count;
    if (count == 0) continue;
    const Segments source = SegmentsOf(links_[l]);
    const auto shift = Shift(links_[l], seed, pass, RandomPurpose::kPair);
    const double divisor = expected < 1 ? expected : count;
    for (int64_t k = 0; k < static_cast<int64_t>(count); ++k) {
      const Segments::Segment s = source.Sample(shift, k);
      tracer.Add(s.from, source.from_normal(), s.to, source.to_normal());
      pending.push_back({&links_[l], s.weight / divisor});
      if (tracer.full()) land();
    }
  }
  land();
  if (is_closed_) transport.exchange.CloseRows(patches_.area_m2);
  return transport;
}

}  // namespace lambert
