// The beam of a spot light, by the cosine of the angle to its axis (KHR_lights_punctual):
//   factor = clamp((cosine - cos_outer) / (cos_inner - cos_outer), 0, 1)^2
#pragma once

namespace lambert {

// A value; all around with the cosines -1 and -1 (Light::cos_inner).
class Cone {
 public:
  // Requires: -1 <= cos_outer <= 1, cos_outer <= cos_inner.
  Cone(double cos_inner, double cos_outer);

  // Of the intensity on the axis, or of what it would be where cos_inner is over 1.
  double Factor(double cosine) const;
  // Integral of the factor over all directions [sr]: 4 pi all around.
  double SolidAngle() const;
  // A cosine with density proportional to the factor, of a number u in [0, 1): falls with u. Equal
  // to the last bit on every machine.
  double SampleCosine(double u) const;

 private:
  double inner_, outer_;
  double cap_ = 0;   // 1 - inner, where that is over 0
  double rim_ = 0;   // widest rim that there is, in cosines, as a share of inner - outer
  double fall_ = 0;  // integral of the factor over the rim
};

}  // namespace lambert
