// run.json: what was run, with what, and what came of it (docs/formats.md).
#pragma once

#include <string>

#include "radiosity/output/picture.h"
#include "radiosity/output/run_record.h"

namespace lambert {

// JSON text, indented. `view` and `exposure` are those of the pictures.
std::string EncodeRunJson(const RunRecord& record, const View& view, const Exposure& exposure);

}  // namespace lambert
