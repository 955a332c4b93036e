// Error measures as text and as JSON.
#pragma once

#include <string>

#include "nlohmann/json_fwd.hpp"
#include "radiosity/output/compare.h"

namespace lambert::app {

// One aligned line a measure, in full precision; "-" where it is undefined.
std::string MeasuresText(const ErrorMeasures& measures);

// {"rms_area":..., "rms_patch":..., ...}; null where undefined.
nlohmann::ordered_json MeasuresJson(const ErrorMeasures& measures);

}  // namespace lambert::app
