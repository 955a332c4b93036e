// Draws rays through the parts of a patch's hemisphere, triangles or squares.
#pragma once

#include <vector>

#include "radiosity/pyramid/concentric_grid.h"
#include "radiosity/pyramid/hemisphere.h"
#include "radiosity/shoot/emitter.h"
#include "radiosity/shoot/options.h"

namespace lambert {

// How the rays of a patch are divided over its hemisphere.
struct Directions {
  std::vector<float> densities;  // fraction of the rays for each cell, sum 1
  // The cells, where they are the patch's own; else those of the sampler.
  std::vector<const SphericalTriangle*> pyramids;
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

  // True where rays of one cell carry different flux.
  bool weighted() const { return weighted_; }
  // Appends rays [begin, end) of a visit, ray begin + k through cells[k]. Writes to weight[slot]
  // what the ray carries over the mean of its cell, where weighted(). Requires: room for them.
  void Append(const EmitterFrame& frame, const Directions& directions, const int32_t* cells,
              const RayNumbers& numbers, uint32_t begin, uint32_t end, RayBatch& batch,
              float* weight) const;

 private:
  const bool squares_, weighted_;
  const Hemisphere hemisphere_;
  const ConcentricGrid grid_;
  const HemisphereCells* const cells_;  // one of the two
  std::vector<const SphericalTriangle*> pyramids_;
  std::vector<double> fractions_;
};

}  // namespace lambert
