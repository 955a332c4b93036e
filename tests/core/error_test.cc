#include "radiosity/core/error.h"

#include <gtest/gtest.h>

#include "radiosity/core/warning.h"

namespace lambert {
namespace {

TEST(MakeError, ReadsWhereWhatWhatToDo) {
  const absl::Status status = MakeError(
      absl::StatusCode::kNotFound, {"SCENE_MISSING", "room.glb", "no such file", "check its name"});
  EXPECT_EQ(status.code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(std::string(status.message()), "room.glb: no such file; check its name");
}

TEST(MakeError, CarriesItsDetailThroughACopy) {
  const ErrorDetail sent{"FIELD_INVALID", "a: b; c", "what, with: signs; and more", ""};
  const absl::Status status = MakeError(absl::StatusCode::kInvalidArgument, sent);
  const absl::Status copy = status;
  const std::optional<ErrorDetail> detail = GetErrorDetail(copy);
  ASSERT_TRUE(detail.has_value());
  EXPECT_EQ(detail->reason, sent.reason);
  EXPECT_EQ(detail->where, sent.where);
  EXPECT_EQ(detail->message, sent.message);
  EXPECT_EQ(detail->hint, sent.hint);
}

TEST(GetErrorDetail, IsNothingForOtherStatuses) {
  EXPECT_FALSE(GetErrorDetail(absl::OkStatus()).has_value());
  EXPECT_FALSE(GetErrorDetail(absl::InternalError("where: what; do this")).has_value());
}

TEST(ReasonOf, IsEmptyForOtherStatuses) {
  EXPECT_EQ(ReasonOf(absl::OkStatus()), "");
  EXPECT_EQ(ReasonOf(absl::InternalError("where: what; do this")), "");
  EXPECT_EQ(ReasonOf(SceneError("a.glb", "it is empty", "export it again")), "SCENE_INVALID");
}

TEST(SceneError, IsAnInvalidArgumentWithReasonSceneInvalid) {
  const absl::Status status = SceneError("a.glb, node 3", "scale is NaN", "export it again");
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  ASSERT_TRUE(GetErrorDetail(status).has_value());
  EXPECT_EQ(ReasonOf(status), "SCENE_INVALID");
  EXPECT_EQ(GetErrorDetail(status)->where, "a.glb, node 3");
}

TEST(Warning, EqualsOnlyTheSameReasonAndMessage) {
  EXPECT_EQ((Warning{"A", "x"}), (Warning{"A", "x"}));
  EXPECT_NE((Warning{"A", "x"}), (Warning{"A", "y"}));
  EXPECT_NE((Warning{"A", "x"}), (Warning{"B", "x"}));
}

}  // namespace
}  // namespace lambert
