#include "client/status.h"

#include "google/rpc/error_details.pb.h"
#include "gtest/gtest.h"
#include "radiosity/core/error.h"

namespace lambert::client {
namespace {

google::rpc::Status Refused() {
  google::rpc::ErrorInfo info;
  info.set_reason("SCENE_INVALID");
  info.set_domain("lambert");
  (*info.mutable_metadata())["where"] = "room.glb, accessor 3";
  (*info.mutable_metadata())["message"] = "runs past its buffer view";
  (*info.mutable_metadata())["hint"] = "export the file again";
  google::rpc::Status status;
  status.set_code(grpc::StatusCode::INVALID_ARGUMENT);
  status.set_message("room.glb, accessor 3: runs past its buffer view; export the file again");
  status.add_details()->PackFrom(info);
  return status;
}

TEST(Status, WhereWhatAndHintComeThroughTheWire) {
  const google::rpc::Status rpc = Refused();
  const absl::Status status = FromGrpc(
      {grpc::StatusCode::INVALID_ARGUMENT, rpc.message(), rpc.SerializeAsString()}, "scene");
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  const auto detail = GetErrorDetail(status);
  ASSERT_TRUE(detail);
  EXPECT_EQ(detail->reason, "SCENE_INVALID");
  EXPECT_EQ(detail->where, "room.glb, accessor 3");
  EXPECT_EQ(detail->message, "runs past its buffer view");
  EXPECT_EQ(detail->hint, "export the file again");
  EXPECT_EQ(FromRpcStatus(rpc, "scene"), status);
}

TEST(Status, AStatusOfTheTransportSaysWhatTheCallWasAbout) {
  const absl::Status status = FromGrpc({grpc::StatusCode::INTERNAL, "stream reset"}, "solveJobs/a");
  EXPECT_EQ(GetErrorDetail(status)->where, "solveJobs/a");
  EXPECT_EQ(GetErrorDetail(status)->message, "stream reset");
}

TEST(Status, GarbledDetailsAreNoMatter) {
  const absl::Status status =
      FromGrpc({grpc::StatusCode::INTERNAL, "stream reset", "\xff\xff\xff"}, "solveJobs/a");
  EXPECT_EQ(GetErrorDetail(status)->message, "stream reset");
}

TEST(Status, OkIsOk) { EXPECT_TRUE(FromGrpc(grpc::Status::OK, "x").ok()); }

}  // namespace
}  // namespace lambert::client
