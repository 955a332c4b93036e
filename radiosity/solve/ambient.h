// The ambient term of stiff scenes: flux that is shot before it has arrived.
//
// Where hardly any flux is lost at a bounce, thousands of bounces pass before a pass ends. What
// they leave is nearly uniform: the rest of a closed room's light is irradiance alike on all its
// patches. So what will still come is shot at once, ahead of its arrival (the ambient term of
// CCWG88), and owed: the debt is unsent flux that is negative. What arrives pays it back but for
// what rays, not the guess, say was lost; what is left over, of either sign, is shot in turn, and
// corrected in turn. Each group of patches that exchange light is treated for itself.
//
// Nothing of this can bias a solution. With b all that has been shot, r what is unsent and E what
// is emitted, r = E + T b - b holds after every step with T the transport that rays measured, whose
// mean is the true one given all that came before. So b has the mean (1 - T)^-1 (E - r), whatever
// was shot ahead, and the pass ends when r is small.
#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/patch/patch_set.h"
#include "radiosity/shoot/unit.h"
#include "radiosity/solve/allocate.h"
#include "radiosity/solve/flux_ledger.h"

namespace lambert {

inline constexpr int32_t kNoGroup = -1;

// Of one pass. A group is stiff as long as it is known or guessed to lose under a few percent of
// its flux at a bounce; flux is shot ahead in stiff groups only.
class Ambient {
 public:
  // Flux of one sign that is shot in one step.
  struct Part {
    int32_t group = kNoGroup;  // a stiff one, or all other emitters together
    double flux_per_ray_lm = 0;
    std::vector<UnsentFlux> unsent;
  };

  // What is known of the solution before.
  struct Before {
    std::vector<Rgb> flux_lm;  // that leaves each patch in the mean of the passes before, or empty
    int64_t rays = 0;          // of those passes
  };

  // What rays carry [lm]. In a stiff group as much as `stiff`, and less where that makes too few
  // rays: under the group's share of `least_rays`, all groups counted alike.
  struct RayFlux {
    double stiff_lm = 0, elsewhere_lm = 0;
    double least_rays = 0;
  };

  // group_of: FindLightGroups. `patches` and `group_of` must outlive it.
  Ambient(const PatchSet& patches, const std::vector<int32_t>& group_of, const Before& before,
          const RayFlux& ray_flux);

  // False where no group is stiff.
  bool Helps() const;

  // What to shoot ahead in each stiff group so that, of what is unsent with it, as much is lost at
  // the next bounce as is unsent now: in the shape of the reflection of a uniform irradiance.
  // Signed, in order of patches; nothing before rays have told what a group loses.
  std::vector<UnsentFlux> Ahead(const FluxLedger& ledger);

  // Parts that together are `unsent`.
  std::vector<Part> Divide(const std::vector<UnsentFlux>& unsent) const;

  // Takes note of what was lost of a part of `sent`, and returns what was shot too little of it, or
  // too much, by rounding, roulette and fractions of rays: in the shape of Ahead, in order. Added
  // to the ledger it keeps the sum of the group exact. Nothing where the part is of no group.
  std::vector<UnsentFlux> Learn(int32_t group, const std::vector<UnsentFlux>& sent,
                                const StepPlan& plan, const UnitResult& result);

  // The share of the flux of a group that is unsent or would have to be shot ahead: of the stiff
  // group that has most.
  double Left(const FluxLedger& ledger) const;
  // Whether what is left everywhere is under a tenth of the least error that a group's rays can
  // have, that of a mean over the group, or is what the noise of the losses makes anew each time;
  // and what is unsent elsewhere is under `elsewhere_lm`.
  bool IsDone(const FluxLedger& ledger, double elsewhere_lm) const;

  // True where over a million rays of a group lost no flux at all in some channel.
  bool LosesNothing() const;

 private:
  // What is known of a group.
  struct Group {
    std::vector<PatchIndex> members;  // in order
    Rgb shape_lm;                     // sum of what `Ahead` spreads in proportion to
    Rgb guess;                        // share lost at a bounce, before rays of this pass have told
    double guess_rays = 0;            // what the guess counts for
    Rgb shot, lost;                   // so far [lm]
    int64_t rays = 0;
    Rgb losses, squared_losses;  // summed over its rays: the share of each that was lost
    double flux_per_ray_lm = 0;  // 0: not chosen yet
    bool chosen = false;         // for the rest of the pass
  };
  // Unsent flux of a group [lm].
  struct Unsent {
    Rgb sum;               // signed
    double magnitude = 0;  // summed over patches and channels
  };
  void GuessFromMaterials();
  void GuessFromSolution(const Before& before);
  Rgb LossOf(const Group& group) const;
  // Whether its loss is known well enough to shoot ahead all that it asks for.
  bool IsSure(const Group& group) const;
  // Chooses the flux of a group's rays when `flux_lm`, magnitudes, is about to be shot.
  void ChooseFluxPerRay(double flux_lm, double least_rays, Group& group) const;
  bool IsStiff(const Group& group) const;
  // Rays that the noise of the losses of as many rays asks to be shot ahead: the variance of the
  // loss of a ray over the square of its mean. Fewer cannot be told from none.
  double NoiseRays(const Group& group) const;
  // By group; one more at the end for all emitters that are of no stiff group.
  std::vector<Unsent> SumByGroup(const std::vector<UnsentFlux>& flux) const;
  std::vector<Rgb> AheadByGroup(const std::vector<Unsent>& unsent) const;
  // Appends flux of a group that is `sum`, in the shape of the reflection of uniform irradiance.
  void Spread(const Group& group, Rgb sum, std::vector<UnsentFlux>& flux) const;
  // By group.
  std::vector<bool> StiffGroups() const;
  // kNoGroup for emitters that are of no stiff group.
  int32_t StiffGroupOf(int32_t emitter, const std::vector<bool>& stiff) const;

  const PatchSet& patches_;
  const std::vector<int32_t>& group_of_;
  const RayFlux ray_flux_;
  std::vector<Group> groups_;
};

}  // namespace lambert
