#include "radiosity/output/write_outputs.h"

#include "radiosity/output/exr.h"
#include "radiosity/output/gathered_light.h"
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

using CornerLight = std::vector<std::array<Rgb, 3>>;

// Irradiance at the corners of patches, and the picture in that light.
struct Lit {
  CornerLight corners;
  std::vector<std::array<Vec3, 3>> normals;  // there; empty without a gather
  Picture picture;
};

absl::StatusOr<Lit> LightPicture(const View& view, const RunRecord& record, const RayScene& scene,
                                 const GatherFunction& gather) {
  const PatchSet& patches = *record.patches;
  const Solution& solution = *record.snapshot.solution;
  const CornerFans fans = FindCornerFans(patches, scene);
  const SurfaceReader surfaces(patches, record.scene.get());
  Lit lit;
  if (gather == nullptr) {
    lit.corners = SmoothIrradiance(patches, fans, solution.irradiance_lx);
    lit.picture = DrawPicture(view, patches, scene, solution, surfaces, lit.corners, kPictureSide,
                              record.picture_options);
    return lit;
  }
  const std::vector<std::array<Vec3, 3>> normals = SmoothNormals(patches, fans);
  absl::StatusOr<CornerLight> corners = GatherCorners(patches, fans, normals, gather);
  if (!corners.ok()) return corners.status();
  absl::StatusOr<Picture> picture =
      DrawGatheredPicture(view, patches, scene, solution, surfaces, *corners, normals, gather,
                          kPictureSide, record.picture_options);
  if (!picture.ok()) return picture.status();
  return Lit{*std::move(corners), normals, *std::move(picture)};
}

// The files that are made of one picture, and run.json, which says how it was taken.
absl::Status WritePictures(const std::string& folder, const RunRecord& record,
                           const OutputFiles& files, const GatherFunction& gather) {
  const absl::StatusOr<std::unique_ptr<RayScene>> scene = RayScene::Create(*record.patches);
  if (!scene.ok()) return scene.status();
  const std::string stem = folder + "/" + record.name;
  const PatchSet& patches = *record.patches;
  const Solution& solution = *record.snapshot.solution;
  const View view = ChooseView(patches, **scene, solution.radiosity_lm_per_m2);
  const absl::StatusOr<Lit> lit = LightPicture(view, record, **scene, gather);
  if (!lit.ok()) return lit.status();
  const Picture& picture = lit->picture;
  std::string png;
  if (files.png || files.report) png = EncodePng(picture.width, picture.height, picture.display);
  absl::Status status;
  if (files.png) status = WriteOutputFile(stem + ".png", png);
  if (status.ok() && files.exr) status = WriteIfOk(stem + ".exr", EncodeExr(picture));
  if (status.ok() && files.glb) {
    status = WriteIfOk(stem + ".glb", EncodeGlb(patches, lit->corners, picture.exposure, view,
                                                record.scene.get()));
  }
  if (status.ok() && record.atlas) {
    status =
        WriteLightmap(stem, record, lit->corners, picture.exposure, view, lit->normals, gather);
  }
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
                          const OutputFiles& files, const GatherFunction& gather) {
  if (absl::Status status = MakeOutputFolder(folder); !status.ok()) return status;
  // The numbers first: they are what a full disk should leave.
  if (files.csv) {
    absl::Status status = WritePatchTable(
        folder + "/patches.csv", MakePatchTable(*record.patches, *record.snapshot.solution));
    if (!status.ok()) return status;
  }
  if (!record.sensors.empty()) {
    absl::Status status =
        WriteOutputFile(folder + "/sensors.csv", EncodeSensorsCsv(record.sensors));
    if (status.ok()) {
      status = WriteOutputFile(folder + "/sensors.json", EncodeSensorsJson(record.sensors));
    }
    if (!status.ok()) return status;
  }
  if (files.NeedPicture() || record.atlas) return WritePictures(folder, record, files, gather);
  return WriteOutputFile(folder + "/run.json", EncodeRunJson(record, std::nullopt));
}

}  // namespace lambert
