// Sine and cosine without libm, equal to the last bit on every machine; error under 1e-14.
#pragma once

namespace lambert {

template <typename Real>
struct SineCosineOf {
  Real sine, cosine;
};
using SineCosine = SineCosineOf<double>;

// Of a number or of lanes. Requires: |x| <= pi.
template <typename Real>
SineCosineOf<Real> SinCos(Real x) {
  // Taylor series of an eighth of the angle, doubled three times.
  const Real t = x * 0.125, t2 = t * t;
  Real s =
      t * (1 + t2 * (-1.0 / 6 +
                     t2 * (1.0 / 120 + t2 * (-1.0 / 5040 + t2 * (1.0 / 362880 - t2 / 39916800)))));
  Real c =
      1 + t2 * (-0.5 +
                t2 * (1.0 / 24 + t2 * (-1.0 / 720 + t2 * (1.0 / 40320 -
                                                          t2 * (1.0 / 3628800 - t2 / 479001600)))));
  for (int doubling = 0; doubling < 3; ++doubling) {
    const Real sine = 2 * s * c;
    c = (c - s) * (c + s);
    s = sine;
  }
  return {s, c};
}

}  // namespace lambert
