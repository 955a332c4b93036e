// `lambert bench`: error against rays and time of several methods, on one scene or several.
#include <cstdio>
#include <map>

#include "app/bench_figures.h"
#include "app/bench_pictures.h"
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

// The files that people look at. Numbers are worth something without pictures.
std::vector<std::string> Draw(const BenchResult& result, ProgressPrinter& printer) {
  std::vector<std::string> files = {result.folder + "/summary.csv",
                                    result.folder + "/convergence.csv"};
  for (auto& drawn : {DrawFigures(result, result.folder + "/figures"),
                      DrawPictures(result, result.folder + "/pictures")}) {
    if (drawn.ok()) {
      files.insert(files.end(), drawn->begin(), drawn->end());
    } else {
      printer.Note("warning: " + std::string(drawn.status().message()));
    }
  }
  return files;
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
    const std::vector<std::string> files = Draw(*result, printer);
    Json json = BenchJson(options, *result);
    json["files"] = files;
    absl::Status written = WriteOutputFile(folders[k] + "/run.json", Dump(json));
    if (!written.ok()) return written;
    results.push_back(std::move(json));
    if (options.json) continue;
    std::printf("%s%s", k == 0 ? "" : "\n", BenchText(*result).c_str());
    for (const std::string& file : files) std::printf("  %s\n", file.c_str());
  }
  if (options.json) std::fputs(Dump({{"scenes", results}}).c_str(), stdout);
  return interrupted ? ExitCode::kInterrupted : ExitCode::kDone;
}

}  // namespace lambert::app
