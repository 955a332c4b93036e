// NAME.exr: the picture in physical units, for lighting and compositing tools.
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "radiosity/lightmap/lightmap.h"
#include "radiosity/output/picture.h"

namespace lambert {

// A single-part, ZIP-compressed OpenEXR file, all channels float32: R, G, B hold the luminance
// [cd/m2] (radiosity / pi) per linear Rec. 709 channel, mean over the pixel; at its middle
// irradiance.R/G/B [lx], std_error.R/G/B, the standard error of the luminance [cd/m2], and
// id.patch, the patch. Where nothing is seen: 0, and -1 for id.patch. Values beyond float32 become
// its largest. Patch numbers over 2^24 are rounded to even ones. INTERNAL where OpenEXR fails.
absl::StatusOr<std::string> EncodeExr(const Picture& picture);

// A page of a lightmap, one part: R, G, B irradiance [lx], `valid` 1 where a surface lies in the
// texel, else 0. Requires: a value a texel.
absl::StatusOr<std::string> EncodeIrradianceExr(const TexelPage& page,
                                                const TexelValues& irradiance_lx);

}  // namespace lambert
