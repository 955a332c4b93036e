// run.json: what was run, with what, and what came of it (docs/formats.md).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "radiosity/output/picture.h"
#include "radiosity/output/run_record.h"

namespace lambert {

// What is done and what is left out, item by item, as run.json and `lambert plan --json` have it.
nlohmann::ordered_json PlanItemsJson(const Plan& plan);

// JSON text, indented. `view` and `exposure` are those of the pictures.
std::string EncodeRunJson(const RunRecord& record, const View& view, const Exposure& exposure);

}  // namespace lambert
