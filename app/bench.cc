// `lambert bench`: error against rays and time of several methods, on one scene or several.
#include <cstdio>
#include <map>

#include "app/bench_scene.h"
#include "app/bench_text.h"
#include "app/commands.h"
#include "app/progress.h"
#include "app/scene_files.h"
#include "app/service.h"
#include "nlohmann/json.hpp"
#include "radiosity/output/output_file.h"

namespace lambert::app {
namespace {

using Json = nlohmann::ordered_json;

std::string Dump(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

// The output folder itself for one scene; of several, each has one in it that is named after it.
std::vector<std::string> SceneFolders(const Options& options) {
  if (options.bench.scenes.size() == 1) return {options.out_folder};
  std::vector<std::string> folders;
  std::map<std::string, int> used;
  for (const std::string& scene : options.bench.scenes) {
    std::string name = SceneStem(scene);
    if (const int times = ++used[name]; times > 1) name += "-" + std::to_string(times);
    folders.push_back(options.out_folder + "/" + name);
  }
  return folders;
}

}  // namespace

absl::StatusOr<ExitCode> RunBench(const Options& options, Interrupt& interrupt) {
  ProgressPrinter printer(ResolveProgressMode(options.progress, stderr), stderr, MonotonicSeconds);
  auto service = OpenService(options, [&](const std::string& line) { printer.Note(line); });
  if (!service.ok()) return service.status();
  const std::vector<std::string> folders = SceneFolders(options);
  Json results = Json::array();
  bool interrupted = false;
  for (size_t k = 0; k < folders.size() && !interrupted; ++k) {
    auto result =
        BenchScene(options, options.bench.scenes[k], folders[k], *service, interrupt, printer);
    if (!result.ok()) return result.status();
    interrupted = result->interrupted;
    Json json = BenchJson(options, *result);
    absl::Status written = WriteOutputFile(folders[k] + "/run.json", Dump(json));
    if (!written.ok()) return written;
    results.push_back(std::move(json));
    if (!options.json) std::printf("%s%s", k == 0 ? "" : "\n", BenchText(*result).c_str());
  }
  if (options.json) std::fputs(Dump({{"scenes", results}}).c_str(), stdout);
  return interrupted ? ExitCode::kInterrupted : ExitCode::kDone;
}

}  // namespace lambert::app
