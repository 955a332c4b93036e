// What GatherService refuses, and whose gathers are whose.
#include "lambert/v1/gather_service.grpc.pb.h"

#include "radiosity/gather/gather_points.h"
#include "tests/service/service_fixture.h"

namespace lambert {
namespace {

class GatherServiceTest : public ServiceFixture {
 protected:
  // A solved room.
  void Solve() {
    AddWorker();
    job_ = Watch(CreateJob(1000).name()).ended;
  }
  grpc::Status Create(const std::string& points, int rays, v1::Gather* gather,
                      int64_t first_point = 0) {
    EXPECT_TRUE(Upload(DigestOf(points), points).ok());
    v1::CreateGatherRequest request;
    request.set_parent(job_.name());
    *request.mutable_points_digest() = DigestOf(points);
    request.set_rays_per_point(rays);
    request.set_first_point(first_point);
    grpc::ClientContext context;
    return stub()->CreateGather(&context, request, gather);
  }
  grpc::Status Get(const std::string& name, v1::Gather* gather) {
    v1::GetGatherRequest request;
    request.set_name(name);
    grpc::ClientContext context;
    return stub()->GetGather(&context, request, gather);
  }
  // Polls until the gather has ended.
  v1::Gather Await(v1::Gather gather) {
    while (gather.state() == v1::Gather::STATE_RUNNING) {
      const std::string name = gather.name();
      EXPECT_TRUE(Get(name, &gather).ok());
    }
    return gather;
  }
  std::unique_ptr<v1::GatherService::Stub> stub() { return v1::GatherService::NewStub(channel()); }

  static std::string SomePoints() {
    GatherPoints points;
    points.Add({0, 0, 0}, {0, 1, 0});
    return EncodeGatherPoints(points);
  }

  v1::SolveJob job_;
};

TEST_F(GatherServiceTest, TheSameQuestionIsTheSameGather) {
  Solve();
  v1::Gather first, second, found;
  ASSERT_TRUE(Create(SomePoints(), 8, &first).ok());
  first = Await(first);
  EXPECT_EQ(first.state(), v1::Gather::STATE_SUCCEEDED);
  EXPECT_EQ(first.done_fraction(), 1);
  ASSERT_TRUE(Create(SomePoints(), 8, &second).ok());
  EXPECT_EQ(second.name(), first.name());
  EXPECT_EQ(second.result_digest().sha256(), first.result_digest().sha256());
  ASSERT_TRUE(Create(SomePoints(), 9, &second).ok());
  EXPECT_NE(second.name(), first.name());
  EXPECT_EQ(Await(second).state(), v1::Gather::STATE_SUCCEEDED);
  ASSERT_TRUE(Create(EncodeGatherPoints({}), 8, &second).ok());  // of no points
  EXPECT_EQ(Await(second).state(), v1::Gather::STATE_SUCCEEDED);
}

TEST_F(GatherServiceTest, WhatIsWrongIsNamed) {
  Solve();
  v1::Gather gather;
  EXPECT_EQ(ReasonOf(Create(SomePoints(), 0, &gather)), "FIELD_INVALID");
  EXPECT_EQ(ReasonOf(Create(SomePoints(), kMaxGatherRays + 1, &gather)), "FIELD_INVALID");
  EXPECT_EQ(ReasonOf(Create(SomePoints(), 8, &gather, -1)), "FIELD_INVALID");
  EXPECT_EQ(ReasonOf(Create(SomePoints(), 8, &gather, int64_t{1} << 32)), "FIELD_INVALID");
  EXPECT_EQ(ReasonOf(Create("no points", 8, &gather)), "GATHER_INVALID");
  EXPECT_EQ(ReasonOf(Get(job_.name() + "/gathers/none", &gather)), "GATHER_NOT_FOUND");
  EXPECT_EQ(ReasonOf(Get("solveJobs/none/gathers/none", &gather)), "JOB_NOT_FOUND");
  job_.set_name("solveJobs/none");
  EXPECT_EQ(ReasonOf(Create(SomePoints(), 8, &gather)), "JOB_NOT_FOUND");
}

TEST_F(GatherServiceTest, AJobWithoutASolutionHasNothingToGatherFrom) {
  job_ = CreateJob(1000);
  v1::Gather gather;
  EXPECT_EQ(ReasonOf(Create(SomePoints(), 8, &gather)), "SNAPSHOT_NOT_FOUND");
}

TEST_F(GatherServiceTest, GoesWithItsJob) {
  Solve();
  v1::Gather gather;
  ASSERT_TRUE(Create(SomePoints(), 8, &gather).ok());
  Await(gather);
  v1::DeleteSolveJobRequest request;
  request.set_name(job_.name());
  grpc::ClientContext context;
  google::protobuf::Empty nothing;
  ASSERT_TRUE(jobs()->DeleteSolveJob(&context, request, &nothing).ok());
  EXPECT_EQ(ReasonOf(Get(gather.name(), &gather)), "JOB_NOT_FOUND");
}

TEST_F(GatherServiceTest, EndsWithTheServer) {
  Solve();
  workers_.clear();
  v1::Gather gather;
  ASSERT_TRUE(Create(SomePoints(), 8, &gather).ok());  // nobody gathers
  coordinator_->Shutdown();
}

}  // namespace
}  // namespace lambert
