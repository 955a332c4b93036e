// report.html: a run on one page that needs no network.
#pragma once

#include <string>

#include "radiosity/output/false_color.h"
#include "radiosity/output/picture.h"
#include "radiosity/output/run_record.h"

namespace lambert {

struct ReportPictures {
  std::string png;              // bytes of the developed picture
  std::string false_color_png;  // bytes of the irradiance picture
  LuxScale scale;               // of the latter
  View view;
  Exposure exposure;
};

// A complete HTML page: pictures, error against time, irradiance per surface, the balance of flux,
// the plan with its reasons, warnings and the facts of the run. No scripts; light and dark; prints
// well.
std::string EncodeReport(const RunRecord& record, const ReportPictures& pictures);

}  // namespace lambert
