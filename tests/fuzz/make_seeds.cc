// fuzz_seeds FOLDER: writes a seed corpus for each fuzzed decoder of radiosity/,
// FOLDER/TARGET/NAME.
#include <cstdio>
#include <string>

#include "radiosity/gather/gather_points.h"
#include "radiosity/shoot/options_codec.h"
#include "radiosity/solve/plan.h"
#include "radiosity/solve/solver.h"
#include "tests/fuzz/corpus.h"
#include "tests/scene/gltf_document.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

// Runs a step's units, and keeps them with their results as seeds.
class RecordingExecutor : public StepExecutor {
 public:
  RecordingExecutor(std::shared_ptr<const Shooter> shooter, Corpus* corpus)
      : shooter_(std::move(shooter)), corpus_(corpus) {}
  absl::StatusOr<UnitResult> RunStep(const std::vector<WorkUnit>& units) override {
    UnitResult merged;
    for (const WorkUnit& unit : units) {
      absl::StatusOr<UnitResult> result = shooter_->Run(unit);
      if (!result.ok()) return result;
      corpus_->Add("unit", EncodeUnit(unit));
      corpus_->Add("unit_result", EncodeUnitResult(*result));
      MergeResult(*result, merged);
    }
    return merged;
  }

 private:
  const std::shared_ptr<const Shooter> shooter_;
  Corpus* const corpus_;
};

void AddScenes(Corpus& corpus) {
  corpus.Add("scene", ToGlb(MakeCornell(1)));
  corpus.Add("scene", ToGlb(SceneMaker().Quad({}, {1, 0, 0}, {0, 1, 0}, {}).Light({}, {}).Make()));
  GltfDocument document;
  corpus.Add("scene", document.Glb());
  corpus.Add("scene", document.json.dump());
  const int texture = document.AddTexture(MakePng(1, 1, std::string(4, '\x80')));
  document.Material()["pbrMetallicRoughness"]["baseColorTexture"]["index"] = texture;
  document.Material()["alphaMode"] = "MASK";
  corpus.Add("scene", document.Glb());
  document.json["buffers"][0]["uri"] = "data.bin";
  document.json["images"][0] = {{"uri", "image.png"}};
  corpus.Add("scene", document.json.dump());
  document.json["buffers"][0]["uri"] = "data:application/octet-stream;base64,AAAAAAAAAAAAAAAA";
  corpus.Add("scene", document.json.dump());
}

void AddGathers(Corpus& corpus) {
  GatherTask task;
  task.radiosity_lm_per_m2 = {{1, 2, 3}, {4, 5, 6}};
  task.points.Add({1, 2, 3}, {0, 1, 0});
  corpus.Add("gather", EncodeGatherPoints(task.points));
  corpus.Add("gather", EncodeGatherTask(task));
  corpus.Add("gather", EncodeGathered({{{1, 2, 3}}, {{0, 0, 1}}}));
}

void AddRuns(Corpus& corpus) {
  const auto patches = std::make_shared<const PatchSet>(PatchesOf(MakeCornell(1)));
  corpus.Add("patch_set", EncodePatchSet(*patches));
  corpus.Add("patch_set", EncodePatchSet(PatchesOf(MakeBox(1, {1, 1, 1}, {{1, 1, 1}}))));
  for (Method method : {Method::kPmcr, Method::kPhsAlpha, Method::kPhsHier}) {
    SolveOptions options;
    options.shoot.method = method;
    options.max_rays = 4000;
    const Plan plan = MakePlan(*patches, options);
    corpus.Add("shoot_options", EncodeShootOptions(plan.options.shoot));
    RecordingExecutor executor(*Shooter::Create(patches, plan.options.shoot), &corpus);
    Solver solver(patches, plan.options, [] { return 0.; });
    solver.RunPass(executor, [](const Progress&) {}).IgnoreError();
    corpus.Add("solution", EncodeSolution(*solver.MakeSnapshot().solution));
    corpus.Add("checkpoint", solver.EncodeCheckpoint());
  }
}

}  // namespace
}  // namespace lambert

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: fuzz_seeds FOLDER\n");
    return 2;
  }
  lambert::Corpus corpus(argv[1]);
  lambert::AddScenes(corpus);
  lambert::AddGathers(corpus);
  lambert::AddRuns(corpus);
  return 0;
}
