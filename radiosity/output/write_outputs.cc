#include "radiosity/output/write_outputs.h"

#include "radiosity/output/exr.h"
#include "radiosity/output/glb.h"
#include "radiosity/output/lightmap_files.h"
#include "radiosity/output/output_file.h"
#include "radiosity/output/patch_table.h"
#include "radiosity/output/png.h"
#include "radiosity/output/report.h"
#include "radiosity/output/run_json.h"
#include "radiosity/output/smooth.h"

namespace lambert {
namespace {

absl::Status WriteIfOk(const std::string& path, const absl::StatusOr<std::string>& bytes) {
  return bytes.ok() ? WriteOutputFile(path, *bytes) : bytes.status();
}

// The files that are made of one picture, and run.json, which says how it was taken.
absl::Status WritePictures(const std::string& folder, const RunRecord& record,
                           const OutputFiles& files) {
  const absl::StatusOr<std::unique_ptr<RayScene>> scene = RayScene::Create(*record.patches);
  if (!scene.ok()) return scene.status();
  const std::string stem = folder + "/" + record.name;
  const PatchSet& patches = *record.patches;
  const Solution& solution = *record.snapshot.solution;
  const View view = ChooseView(patches, **scene, solution.radiosity_lm_per_m2);
  const std::vector<std::array<Rgb, 3>> light =
      SmoothIrradiance(patches, FindCornerFans(patches, **scene), solution.irradiance_lx);
  const Picture picture = DrawPicture(view, patches, **scene, solution, light);
  std::string png;
  if (files.png || files.report) png = EncodePng(picture.width, picture.height, picture.display);
  absl::Status status;
  if (files.png) status = WriteOutputFile(stem + ".png", png);
  if (status.ok() && files.exr) status = WriteIfOk(stem + ".exr", EncodeExr(picture));
  if (status.ok() && files.glb) {
    status = WriteIfOk(stem + ".glb",
                       EncodeGlb(patches, light, picture.exposure, view, record.scene.get()));
  }
  if (status.ok() && record.atlas)
    status = WriteLightmap(stem, record, light, picture.exposure, view);
  if (status.ok()) {
    status = WriteOutputFile(folder + "/run.json",
                             EncodeRunJson(record, PictureFacts{view, picture.exposure}));
  }
  if (!status.ok() || !files.report) return status;
  const LuxScale scale = ChooseLuxScale(picture);
  const ReportPictures pictures{
      png, EncodePng(picture.width, picture.height, FalseColorPicture(picture, scale)), scale, view,
      picture.exposure};
  return WriteOutputFile(folder + "/report.html", EncodeReport(record, pictures));
}

}  // namespace

absl::Status WriteOutputs(const std::string& folder, const RunRecord& record,
                          const OutputFiles& files) {
  if (absl::Status status = MakeOutputFolder(folder); !status.ok()) return status;
  // The numbers first: they are what a full disk should leave.
  if (files.csv) {
    absl::Status status = WritePatchTable(
        folder + "/patches.csv", MakePatchTable(*record.patches, *record.snapshot.solution));
    if (!status.ok()) return status;
  }
  if (files.NeedPicture() || record.atlas) return WritePictures(folder, record, files);
  return WriteOutputFile(folder + "/run.json", EncodeRunJson(record, std::nullopt));
}

}  // namespace lambert
