// run.json: what was run, with what, and what came of it (docs/formats.md).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "radiosity/output/picture.h"
#include "radiosity/output/run_record.h"

namespace lambert {

// What a run's patches were asked to be.
nlohmann::ordered_json PatchOptionsJson(const PatchOptions& options);

// What is done and what is left out, item by item, as run.json and `lambert plan --json` have it.
nlohmann::ordered_json PlanItemsJson(const Plan& plan);

// How the pictures of a run were taken.
struct PictureFacts {
  View view;
  Exposure exposure;
};

// JSON text, indented. `picture`: nullopt where none was drawn.
std::string EncodeRunJson(const RunRecord& record, const std::optional<PictureFacts>& picture);

}  // namespace lambert
