// fuzz_request_seeds FOLDER: writes the seed corpora of specs and requests, FOLDER/TARGET/NAME.
#include <cstdio>
#include <string>

#include "radiosity/shoot/settings.h"
#include "radiosity/shoot/shooter.h"
#include "tests/fuzz/corpus.h"
#include "tests/service/rpc_methods.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

// A message for requests_fuzz.cc.
std::string Message(const std::string& method, const google::protobuf::Message& body) {
  const auto methods = AllRpcMethods();
  size_t picked = 0;
  while (PathOf(*methods[picked]) != method) ++picked;
  const std::string bytes = body.SerializeAsString();
  return std::string{static_cast<char>(picked), static_cast<char>(bytes.size() & 0xff),
                     static_cast<char>(bytes.size() >> 8)} +
         bytes;
}

void AddSpecs(Corpus& corpus) {
  v1::SolveSpec spec;
  corpus.Add("spec", spec.SerializeAsString());
  spec.set_seed(7);
  spec.set_max_error(.01);
  spec.set_max_ray_count(1'000'000);
  spec.mutable_patch()->set_max_edge_meters(.5);
  for (const ShootSetting& setting : ShootSettings()) {
    spec.mutable_shoot()->set_method("phs");
    (*spec.mutable_shoot()->mutable_settings())[setting.name] = "2";
    corpus.Add("spec", spec.SerializeAsString());
    spec.mutable_shoot()->mutable_settings()->clear();
  }
}

void AddRequests(Corpus& corpus) {
  const std::string scene = ToGlb(MakeBox(1, {.5, .5, .5}, {{1, 1, 1}}));
  v1::UploadBlobRequest upload;
  upload.mutable_digest()->set_sha256(Sha256Hex(scene));
  upload.mutable_digest()->set_size_bytes(static_cast<int64_t>(scene.size()));
  upload.set_data(scene);
  v1::CreateSceneRequest create;
  create.add_files()->set_uri("box.glb");
  *create.mutable_files(0)->mutable_digest() = upload.digest();
  const std::string manifest = std::string("box.glb") + '\0' + upload.digest().sha256() + '\0' +
                               std::to_string(scene.size()) + '\n';
  v1::CreateSolveJobRequest job;
  job.set_scene("scenes/" + Sha256Hex(manifest));
  job.set_solve_job_id("one");
  job.mutable_spec()->set_max_ray_count(1000);
  v1::WatchSnapshotsRequest watch;
  watch.set_parent("solveJobs/one");
  watch.set_view(v1::SNAPSHOT_VIEW_FULL);
  v1::CancelSolveJobRequest cancel;
  cancel.set_name("solveJobs/one");
  v1::DeleteSolveJobRequest remove;
  remove.set_name("solveJobs/one");
  worker::v1::CreateWorkerSessionRequest session;
  session.set_worker_id("worker");
  session.set_slot_count(1);
  session.set_unit_version(UnitVersion());
  worker::v1::SubmitUnitResultRequest submit;
  submit.mutable_unit_key()->set_solve_job("solveJobs/one");
  submit.mutable_result_digest()->set_sha256(Sha256Hex(std::string()));
  const std::string jobs = "/lambert.v1.SolveJobService/";
  const std::string workers = "/lambert.worker.v1.WorkerService/";
  const std::string all =
      Message("/lambert.v1.BlobService/UploadBlob", upload) +
      Message("/lambert.v1.SceneService/CreateScene", create) +
      Message(jobs + "CreateSolveJob", job) + Message(workers + "CreateWorkerSession", session) +
      Message(workers + "SubmitUnitResult", submit) + Message(jobs + "CancelSolveJob", cancel) +
      Message("/lambert.v1.SnapshotService/WatchSnapshots", watch) +
      Message(jobs + "DeleteSolveJob", remove);
  corpus.Add("requests", all);
  // Every method once, its body empty.
  for (const google::protobuf::MethodDescriptor* method : AllRpcMethods()) {
    corpus.Add("requests", Message(PathOf(*method), v1::Digest()));
  }
}

}  // namespace
}  // namespace lambert

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: fuzz_request_seeds FOLDER\n");
    return 2;
  }
  lambert::Corpus corpus(argv[1]);
  lambert::AddSpecs(corpus);
  lambert::AddRequests(corpus);
  return 0;
}
