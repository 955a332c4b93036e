#include "radiosity/core/error.h"
#include "tests/service/service_fixture.h"

namespace lambert {
namespace {

using SceneService = ServiceFixture;

TEST_F(SceneService, AnUploadGoesOnWhereItBrokeOff) {
  const std::string bytes(3'000'000, 'x');
  const v1::Digest digest = DigestOf(bytes);
  EXPECT_TRUE(Upload(digest, bytes.substr(0, 1'000'000)).ok());
  v1::GetBlobUploadRequest request;
  *request.mutable_digest() = digest;
  v1::BlobUpload upload;
  grpc::ClientContext before;
  ASSERT_TRUE(blobs()->GetBlobUpload(&before, request, &upload).ok());
  EXPECT_EQ(upload.committed_size_bytes(), 1'000'000);
  EXPECT_FALSE(upload.complete());
  EXPECT_TRUE(Upload(digest, bytes.substr(1'000'000), 1'000'000).ok());
  grpc::ClientContext after;
  ASSERT_TRUE(blobs()->GetBlobUpload(&after, request, &upload).ok());
  EXPECT_TRUE(upload.complete());
}

TEST_F(SceneService, ADownloadBeginsWhereItIsAskedTo) {
  const std::string bytes = std::string(1'500'000, 'a') + "end";
  ASSERT_TRUE(Upload(DigestOf(bytes), bytes).ok());
  v1::DownloadBlobRequest request;
  request.set_sha256(Sha256Hex(bytes));
  request.set_offset_bytes(1'499'999);
  grpc::ClientContext context;
  auto reader = blobs()->DownloadBlob(&context, request);
  std::string received;
  v1::DownloadBlobResponse piece;
  while (reader->Read(&piece)) received += piece.data();
  EXPECT_TRUE(reader->Finish().ok());
  EXPECT_EQ(received, "aend");
}

TEST_F(SceneService, RefusesBadUploadsByName) {
  const std::string bytes = "some bytes";
  v1::Digest digest = DigestOf(bytes);
  EXPECT_EQ(ReasonOf(Upload(digest, "some bytez")), "DIGEST_MISMATCH");
  EXPECT_EQ(ReasonOf(Upload(digest, bytes, 3)), "OFFSET_MISMATCH");
  EXPECT_EQ(ErrorInfoOf(Upload(digest, bytes, 3)).metadata().at("committedSizeBytes"), "0");
  EXPECT_EQ(
      ReasonOf(Upload(DigestOf(std::string(2 << 20, 'x')), std::string(2 << 20, 'x'), 0, 2 << 20)),
      "FIELD_INVALID");
  digest.set_sha256("../jobs/x");
  EXPECT_EQ(ReasonOf(Upload(digest, bytes)), "FIELD_INVALID");
}

TEST_F(SceneService, FindsMissingBlobsOnce) {
  ASSERT_TRUE(Upload(DigestOf("here"), "here").ok());
  v1::FindMissingBlobsRequest request;
  for (const char* bytes : {"here", "missing", "missing"}) *request.add_digests() = DigestOf(bytes);
  v1::FindMissingBlobsResponse response;
  grpc::ClientContext context;
  ASSERT_TRUE(blobs()->FindMissingBlobs(&context, request, &response).ok());
  ASSERT_EQ(response.missing_digests_size(), 1);
  EXPECT_EQ(response.missing_digests(0).sha256(), DigestOf("missing").sha256());
}

TEST_F(SceneService, NamesTheBlobsThatASceneLacks) {
  v1::CreateSceneRequest request;
  request.add_files()->set_uri("room.glb");
  *request.mutable_files(0)->mutable_digest() = DigestOf("nowhere");
  v1::Scene scene;
  grpc::ClientContext context;
  const grpc::Status status = scenes()->CreateScene(&context, request, &scene);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  EXPECT_EQ(ReasonOf(status), "BLOBS_MISSING");
  google::rpc::Status details;
  ASSERT_TRUE(details.ParseFromString(status.error_details()));
  google::rpc::PreconditionFailure failure;
  ASSERT_TRUE(details.details(1).UnpackTo(&failure));
  EXPECT_EQ(failure.violations(0).type(), "MISSING");
  EXPECT_EQ(failure.violations(0).subject(), "blobs/" + Sha256Hex(std::string("nowhere")) + "/7");
}

TEST_F(SceneService, ARefusedSceneLeavesNothingBehind) {
  v1::Scene scene;
  const grpc::Status status = CreateScene("this is no scene", &scene);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  const google::rpc::ErrorInfo info = ErrorInfoOf(status);
  EXPECT_EQ(info.reason(), "SCENE_INVALID");
  EXPECT_EQ(info.domain(), "lambert");
  for (const char* key : {"where", "message", "hint"})
    EXPECT_NE(info.metadata().at(key), "") << key;
  EXPECT_FALSE(coordinator_->blobs().Has(Sha256Hex(std::string("this is no scene"))));
  EXPECT_TRUE(coordinator_->scenes().List(0, "")->items.empty());
}

TEST_F(SceneService, EqualScenesAreOneScene) {
  v1::Scene first, second;
  const std::string glb = ToGlb(MakeCornell(1));
  ASSERT_TRUE(CreateScene(glb, &first).ok());
  ASSERT_TRUE(CreateScene(glb, &second).ok());
  EXPECT_EQ(first.name(), second.name());
  const std::string manifest =
      std::string("room.glb") + '\0' + Sha256Hex(glb) + '\0' + std::to_string(glb.size()) + '\n';
  EXPECT_EQ(first.name(), "scenes/" + Sha256Hex(manifest));
}

TEST_F(SceneService, ASceneThatIsBeingSolvedIsNotDeleted) {
  const v1::SolveJob job = CreateJob();  // no worker: it does not end
  v1::DeleteSceneRequest request;
  request.set_name(job.scene());
  google::protobuf::Empty empty;
  grpc::ClientContext during, after;
  EXPECT_EQ(ReasonOf(scenes()->DeleteScene(&during, request, &empty)), "SCENE_IN_USE");
  AddWorker();
  Watch(job.name());
  EXPECT_TRUE(scenes()->DeleteScene(&after, request, &empty).ok());
}

TEST_F(SceneService, NamesTheFieldThatIsWrong) {
  v1::ListScenesRequest request;
  request.set_page_size(-1);
  v1::ListScenesResponse response;
  grpc::ClientContext context;
  google::rpc::Status details;
  ASSERT_TRUE(
      details.ParseFromString(scenes()->ListScenes(&context, request, &response).error_details()));
  google::rpc::BadRequest wrong;
  ASSERT_TRUE(details.details(1).UnpackTo(&wrong));
  EXPECT_EQ(wrong.field_violations(0).field(), "page_size");
}

}  // namespace
}  // namespace lambert
