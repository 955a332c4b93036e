#include <algorithm>
#include <cstdio>

#include "app/commands.h"
#include "app/measure.h"
#include "app/measures_text.h"
#include "nlohmann/json.hpp"
#include "radiosity/output/compare.h"
#include "radiosity/output/patch_table.h"

namespace lambert::app {

absl::StatusOr<ExitCode> RunCompare(const Options& options, Interrupt& interrupt) {
  auto table = ReadPatchTable(options.compare_path);
  if (!table.ok()) return table.status();
  auto reference = ReadPatchTable(options.compare_reference);
  if (!reference.ok()) return reference.status();
  // The tables know nodes by index only.
  int nodes = 0;
  for (const PatchSource& source : reference->source) nodes = std::max(nodes, source.node + 1);
  auto regions = FindRegions(options.regions, std::vector<std::string>(nodes));
  if (!regions.ok()) return regions.status();
  auto measures = Compare(*table, *reference, *regions);
  if (!measures.ok()) return measures.status();
  if (options.json) {
    std::printf("%s\n", MeasuresJson(*measures).dump().c_str());
  } else {
    std::fputs(MeasuresText(*measures).c_str(), stdout);
  }
  return ExitCode::kDone;
}

}  // namespace lambert::app
