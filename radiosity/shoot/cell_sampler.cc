#include "radiosity/shoot/cell_sampler.h"

#include <numbers>

namespace lambert {

CellSampler::CellSampler(const PyramidOptions& options)
    : squares_(options.cells == CellShape::kSquare),
      weighted_(!squares_ && options.sampling == PyramidSampling::kSolidAngle),
      hemisphere_(options.initial, options.split, squares_ ? 0 : options.depth),
      grid_(options.grid),
      cells_(squares_ ? static_cast<const HemisphereCells*>(&grid_) : &hemisphere_) {
  for (int p = 0; p < cells_->size(); ++p) fractions_.push_back(cells_->flux_fraction(p));
}

void CellSampler::Append(const EmitterFrame8& frames, const CellRays8& rays,
                         const RandomNumbers8& numbers, const RandomStream& stream, int count,
                         RayBatch& batch, float* weight) const {
  if (squares_) {
    AppendGridRays(frames, grid_.side(), rays.cells, numbers, count, batch);
    return;
  }
  if (!weighted_) {
    AppendProjectedAngleRays(frames, rays.pyramids, numbers, stream, rays.names, count, batch);
    return;
  }
  const int first = batch.size;
  AppendSolidAngleRays(frames, rays.pyramids, numbers, count, batch, weight);
  // phi_ray = Phi_i cos(theta) Omega_p / (pi r_ip)  (JPS00, 3.2), over the mean Phi_i f_p / r_ip.
  for (int k = 0; k < count; ++k) {
    const SphericalTriangle& t = *rays.pyramids[k];
    weight[first + k] *=
        static_cast<float>(t.solid_angle() / (std::numbers::pi * t.flux_fraction()));
  }
}

}  // namespace lambert
