// Draws rays through the parts of a patch's hemisphere, triangles or squares.
#pragma once

#include <vector>

#include "radiosity/pyramid/concentric_grid.h"
#include "radiosity/pyramid/density.h"
#include "radiosity/pyramid/hemisphere.h"
#include "radiosity/shoot/emitter.h"
#include "radiosity/shoot/options.h"

namespace lambert {

// How the rays of a patch are divided over its hemisphere.
struct Directions {
  CellSpans spans;  // as long as the fraction of the rays for each cell
  // The cells, where they are the patch's own; else those of the sampler.
  std::vector<const SphericalTriangle*> pyramids;
};

// Eight rays of any patches that leave through cells, lane by lane.
struct CellRays8 {
  RayNames8 names;
  int32_t cells[8] = {};
  const SphericalTriangle* pyramids[8] = {};  // CellSampler::Pyramid of the cells
};

// Immutable; any number of threads at once.
class CellSampler {
 public:
  explicit CellSampler(const PyramidOptions& options);

  const HemisphereCells& cells() const { return *cells_; }
  // Requires: the cells are triangles.
  const Hemisphere& hemisphere() const { return hemisphere_; }
  // f_p of each cell.
  const std::vector<double>& fractions() const { return fractions_; }
  double Fraction(const Directions& directions, int cell) const {
    return directions.pyramids.empty() ? fractions_[cell]
                                       : directions.pyramids[cell]->flux_fraction();
  }
  // Null where the cells are squares.
  const SphericalTriangle* Pyramid(const Directions& directions, int cell) const {
    if (squares_) return nullptr;
    return directions.pyramids.empty() ? &hemisphere_.pyramid(cell) : directions.pyramids[cell];
  }

  // True where rays of one cell carry different flux.
  bool weighted() const { return weighted_; }
  // Appends `count` <= 8 rays. Writes to weight[slot] what the ray carries over the mean of its
  // cell, where weighted(). Requires: eight valid lanes, room for `count` rays.
  void Append(const EmitterFrame8& frames, const CellRays8& rays, const RandomNumbers8& numbers,
              const RandomStream& stream, int count, RayBatch& batch, float* weight) const;

 private:
  const bool squares_, weighted_;
  const Hemisphere hemisphere_;
  const ConcentricGrid grid_;
  const HemisphereCells* const cells_;  // one of the two
  std::vector<double> fractions_;
};

}  // namespace lambert
