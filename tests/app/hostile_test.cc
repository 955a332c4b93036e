// Files that are broken, or made to break what reads them, given to the command in a process with
// 10 s and 512 MiB. Skipped where the corpus is not there.
#include <chrono>
#include <cmath>
#include <future>
#include <map>
#include <regex>
#include <set>

#include "nlohmann/json.hpp"
#include "tests/app/command_fixture.h"

namespace lambert::app {
namespace {

namespace fs = std::filesystem;

// Where the command ends otherwise than the corpus says, and why; docs/input.md, "Held against
// others".
const std::map<std::string, std::string>& Argued() {
  static const auto& argued = *new std::map<std::string, std::string>{
      {"BoxBadNormals.glb", "light needs neither bounds nor vertex normals"},
      {"121_albedo_1_5.glb", "reflectance over 1 is clamped, with a warning"},
      {"021_json_bom.gltf", "its buffer has no data"},
      {"027_duplicate_keys.gltf", "its buffer has no data"},
      {"051_scale_zero.glb", "nothing is left to light"},
      {"080_sparse_override_degenerate.glb", "nothing is left to light"},
      {"buffer/custom_property.gltf", "its buffer has no data"},
      {"buffer/data_uri.glb", "data URIs are read in base64"},
      {"buffer/valid_placeholder.glb", "its buffer has no data"},
      {"json/integer_written_as_float.gltf", "its buffer has no data"},
      {"mesh/valid.gltf", "indices are written without a point"},
      {"accessor/unknown_type.gltf", "the type is none of glTF 2.0"},
      {"light/unknown_type.gltf", "the type is none of KHR_lights_punctual"},
      {"target/valid.gltf", "an animation without a node is none of glTF 2.0"},
  };
  return argued;
}

struct HostileFile {
  fs::path path;
  bool is_refused = false;
  bool is_argued = false;
};

bool HasErrors(const nlohmann::json& report) {
  for (const auto& message : report["issues"]["messages"]) {
    if (message["severity"] == 0) return true;
  }
  return false;
}

std::vector<HostileFile> Corpus() {
  const fs::path root = fs::path(LAMBERT_SHARED_SCENES) / "hostile";
  std::vector<HostileFile> files;
  if (!fs::is_directory(root)) return files;
  std::map<std::string, bool> own;
  for (const auto& file : nlohmann::json::parse(ReadFile(root / "own/MANIFEST.json"))) {
    own["own/" + file["file"].get<std::string>()] = file["expect"] == "reject";
  }
  for (const auto& file : nlohmann::json::parse(ReadFile(root / "VALIDATOR_RESULTS.json"))) {
    const std::string name = file["file"];
    HostileFile hostile{root / name};
    const fs::path report = root / (name + ".report.json");
    if (const auto found = own.find(name); found != own.end()) {
      hostile.is_refused = found->second;
    } else if (fs::exists(report)) {
      hostile.is_refused = HasErrors(nlohmann::json::parse(ReadFile(report)));
    } else {
      hostile.is_refused = file.value("errors", 1) > 0;
    }
    for (const auto& [end, reason] : Argued()) hostile.is_argued |= name.ends_with("/" + end);
    files.push_back(hostile);
  }
  return files;
}

class Hostile : public CommandFixture {
 protected:
  // Runs the command in a process of its own limits. With sanitizers, whose shadows are terabytes
  // of addresses, resident memory is limited and not addresses.
  Ran RunLimited(const std::string& arguments) {
#ifdef __SANITIZE_ADDRESS__
    const std::string limit;
    ProcessOptions here = Here();
    here.environment["ASAN_OPTIONS"] = "hard_rss_limit_mb=512:quarantine_size_mb=16";
#else
    const std::string limit = "ulimit -v 524288; ";
    const ProcessOptions here = Here();
#endif
    Process process(
        {"/bin/bash", "-c", limit + "exec timeout -s KILL 10 " LAMBERT_COMMAND + arguments}, here);
    const int exit_code = process.Wait();
    return {exit_code, process.output(), process.error()};
  }

  void ExpectOneLine(const Ran& ran) {
    EXPECT_TRUE(std::regex_search(ran.error, std::regex("(^|\n)error: [^\n]+: [^\n]+; [^\n]+\n$")))
        << ran.error;
    EXPECT_NE(ran.output.find("\"reason\""), std::string::npos) << ran.output;
  }

  void ExpectEnd(const HostileFile& file, const Ran& ran) {
    SCOPED_TRACE(file.path.string());
    // A file can be right and hold nothing that light could fall on.
    const bool is_empty = ran.output.find("\"NO_TRIANGLES\"") != std::string::npos;
    if (ran.exit_code == 3) ExpectOneLine(ran);
    const int wanted = file.is_refused != file.is_argued ? 3 : 0;
    EXPECT_TRUE(ran.exit_code == wanted || (ran.exit_code == 3 && is_empty))
        << ran.exit_code << ": " << ran.output << ran.error;
  }

  // Runs `arguments` of each file, several at once, and looks at what `check` says of each end.
  template <typename Check>
  void ForEachFile(const std::function<std::string(size_t)>& arguments, Check check) {
    const std::vector<HostileFile> files = Corpus();
    if (files.empty()) GTEST_SKIP() << "no hostile scenes";
    std::vector<std::future<Ran>> running;
    const auto start = [&](size_t k) {
      running.push_back(std::async(std::launch::async, [this, &files, &arguments, k] {
        return RunLimited(" " + arguments(k) + " '" + files[k].path.string() + "' --json");
      }));
    };
    constexpr size_t kAtOnce = 3;
    for (size_t k = 0; k < std::min(kAtOnce, files.size()); ++k) start(k);
    for (size_t k = 0; k < files.size(); ++k) {
      check(k, files[k], running[k].get());
      if (k + kAtOnce < files.size()) start(k + kAtOnce);
    }
  }
};

TEST_F(Hostile, EveryFileIsPlannedOrRefusedAsItsCorpusSays) {
  ForEachFile([](size_t) { return std::string("plan"); },
              [this](size_t, const HostileFile& file, const Ran& ran) { ExpectEnd(file, ran); });
}

TEST_F(Hostile, EveryFileIsBakedToFiniteNumbersOrRefused) {
  const auto out = [](size_t k) { return "out" + std::to_string(k); };
  const std::regex not_finite("\\b(nan|inf|NaN|Infinity)\\b");
  ForEachFile(
      [&](size_t k) {
        return "bake --threads 1 --max-rays 1000 --progress none --outputs csv,glb -o " + out(k);
      },
      [&](size_t k, const HostileFile& file, const Ran& ran) {
        ExpectEnd(file, ran);
        SCOPED_TRACE(file.path.string());
        EXPECT_EQ(fs::exists(folder_ / out(k) / "run.json"), ran.exit_code == 0);
        if (ran.exit_code != 0) return;
        for (const char* name : {"/patches.csv", "/convergence.csv", "/run.json"}) {
          EXPECT_FALSE(std::regex_search(Read(out(k) + name), not_finite)) << name;
        }
        fs::remove_all(folder_ / out(k));
      });
}

}  // namespace
}  // namespace lambert::app
