#include <memory>
#include <utility>

#include "lambert/v1/solve_job_service.grpc.pb.h"
#include "server/coordinator.h"
#include "server/rpc/reply.h"
#include "server/rpc/services.h"

namespace lambert::server {
namespace {

class SolveJobService : public v1::SolveJobService::CallbackService {
 public:
  explicit SolveJobService(Coordinator* coordinator) : coordinator_(coordinator) {}

  grpc::ServerUnaryReactor* PlanScene(grpc::CallbackServerContext* context,
                                      const v1::PlanSceneRequest* request,
                                      v1::PlanSceneResponse* response) override {
    grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
    coordinator_->pool().Run([this, reactor, request, response] {
      absl::StatusOr<v1::PlanSceneResponse> plan = coordinator_->PlanScene(*request);
      if (plan.ok()) *response = *std::move(plan);
      reactor->Finish(ToGrpc(plan.status()));
    });
    return reactor;
  }
  grpc::ServerUnaryReactor* CreateSolveJob(grpc::CallbackServerContext* context,
                                           const v1::CreateSolveJobRequest* request,
                                           v1::SolveJob* response) override {
    return Reply(context, coordinator_->CreateJob(*request), response);
  }
  grpc::ServerUnaryReactor* GetSolveJob(grpc::CallbackServerContext* context,
                                        const v1::GetSolveJobRequest* request,
                                        v1::SolveJob* response) override {
    absl::StatusOr<std::shared_ptr<Job>> job = coordinator_->jobs().Find(request->name());
    if (!job.ok()) return Reply(context, job.status());
    *response = (*job)->Get();
    return Reply(context, absl::OkStatus());
  }
  grpc::ServerUnaryReactor* ListSolveJobs(grpc::CallbackServerContext* context,
                                          const v1::ListSolveJobsRequest* request,
                                          v1::ListSolveJobsResponse* response) override {
    absl::StatusOr<Page<std::shared_ptr<Job>>> page =
        coordinator_->jobs().List(request->page_size(), request->page_token());
    if (!page.ok()) return Reply(context, page.status());
    for (const std::shared_ptr<Job>& job : page->items) *response->add_solve_jobs() = job->Get();
    response->set_next_page_token(page->next_page_token);
    return Reply(context, absl::OkStatus());
  }
  grpc::ServerUnaryReactor* CancelSolveJob(grpc::CallbackServerContext* context,
                                           const v1::CancelSolveJobRequest* request,
                                           v1::SolveJob* response) override {
    return Reply(context, coordinator_->CancelJob(request->name()), response);
  }
  grpc::ServerUnaryReactor* DeleteSolveJob(grpc::CallbackServerContext* context,
                                           const v1::DeleteSolveJobRequest* request,
                                           google::protobuf::Empty*) override {
    return Reply(context, coordinator_->jobs().Delete(request->name()));
  }

 private:
  Coordinator* const coordinator_;
};

}  // namespace

std::unique_ptr<grpc::Service> MakeSolveJobService(Coordinator* coordinator) {
  return std::make_unique<SolveJobService>(coordinator);
}

}  // namespace lambert::server
