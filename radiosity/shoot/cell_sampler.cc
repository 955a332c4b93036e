#include "radiosity/shoot/cell_sampler.h"

#include <numbers>

namespace lambert {

CellSampler::CellSampler(const PyramidOptions& options)
    : squares_(options.cells == CellShape::kSquare),
      weighted_(!squares_ && options.sampling == PyramidSampling::kSolidAngle),
      hemisphere_(options.initial, options.split, squares_ ? 0 : options.depth),
      grid_(options.grid),
      cells_(squares_ ? static_cast<const HemisphereCells*>(&grid_) : &hemisphere_) {
  if (!squares_) {
    for (int p = 0; p < hemisphere_.size(); ++p) pyramids_.push_back(&hemisphere_.pyramid(p));
  }
  for (int p = 0; p < cells_->size(); ++p) fractions_.push_back(cells_->flux_fraction(p));
}

void CellSampler::Append(const EmitterFrame& frame, const Directions& directions,
                         const int32_t* cells, const RayNumbers& numbers, uint32_t begin,
                         uint32_t end, RayBatch& batch, float* weight) const {
  if (squares_) {
    AppendGridRays(frame, grid_.side(), cells, numbers, begin, end, batch);
    return;
  }
  const auto& pyramids = directions.pyramids.empty() ? pyramids_ : directions.pyramids;
  const SphericalTriangle* of_ray[RayBatch::kCapacity] = {};
  for (uint32_t k = 0; k < end - begin; ++k) of_ray[k] = pyramids[cells[k]];
  if (!weighted_) {
    AppendProjectedAngleRays(frame, of_ray, numbers, begin, end, batch);
    return;
  }
  const int first = batch.size;
  AppendSolidAngleRays(frame, of_ray, numbers, begin, end, batch, weight);
  // phi_ray = Phi_i cos(theta) Omega_p / (pi r_ip)  (JPS00, 3.2), over the mean Phi_i f_p / r_ip.
  for (uint32_t k = 0; k < end - begin; ++k) {
    const SphericalTriangle& t = *of_ray[k];
    weight[first + static_cast<int>(k)] *=
        static_cast<float>(t.solid_angle() / (std::numbers::pi * t.flux_fraction()));
  }
}

}  // namespace lambert
