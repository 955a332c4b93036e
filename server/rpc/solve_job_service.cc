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
  SolveJobService(Coordinator* coordinator, const Doors* doors)
      : coordinator_(coordinator), doors_(*doors) {}

  grpc::ServerUnaryReactor* PlanScene(grpc::CallbackServerContext* context,
                                      const v1::PlanSceneRequest* request,
                                      v1::PlanSceneResponse* response) override {
    const absl::StatusOr<Identity> caller = doors_.Admit(*context, Guests::kClients);
    if (!caller.ok()) return Reply(context, caller.status());
    grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
    coordinator_->pool().Run([this, caller = *caller, reactor, request, response] {
      absl::StatusOr<v1::PlanSceneResponse> plan = coordinator_->PlanScene(caller, *request);
      if (plan.ok()) *response = *std::move(plan);
      reactor->Finish(ToGrpc(plan.status()));
    });
    return reactor;
  }
  grpc::ServerUnaryReactor* CreateSolveJob(grpc::CallbackServerContext* context,
                                           const v1::CreateSolveJobRequest* request,
                                           v1::SolveJob* response) override {
    return Answer(context, doors_, Guests::kClients, response, [&](const Identity& caller) {
      return coordinator_->CreateJob(caller, *request);
    });
  }
  grpc::ServerUnaryReactor* GetSolveJob(grpc::CallbackServerContext* context,
                                        const v1::GetSolveJobRequest* request,
                                        v1::SolveJob* response) override {
    return Answer(context, doors_, Guests::kClients, response,
                  [&](const Identity& caller) { return Get(caller, request->name()); });
  }
  grpc::ServerUnaryReactor* ListSolveJobs(grpc::CallbackServerContext* context,
                                          const v1::ListSolveJobsRequest* request,
                                          v1::ListSolveJobsResponse* response) override {
    return Answer(context, doors_, Guests::kClients, response,
                  [&](const Identity& caller) { return List(caller, *request); });
  }
  grpc::ServerUnaryReactor* CancelSolveJob(grpc::CallbackServerContext* context,
                                           const v1::CancelSolveJobRequest* request,
                                           v1::SolveJob* response) override {
    return Answer(context, doors_, Guests::kClients, response, [&](const Identity& caller) {
      return coordinator_->CancelJob(caller, request->name());
    });
  }
  grpc::ServerUnaryReactor* DeleteSolveJob(grpc::CallbackServerContext* context,
                                           const v1::DeleteSolveJobRequest* request,
                                           google::protobuf::Empty*) override {
    return Answer(context, doors_, Guests::kClients, [&](const Identity& caller) {
      return coordinator_->jobs().Delete(request->name(), caller);
    });
  }

 private:
  absl::StatusOr<v1::SolveJob> Get(const Identity& caller, const std::string& name) {
    absl::StatusOr<std::shared_ptr<Job>> job = coordinator_->jobs().Find(name, caller);
    if (!job.ok()) return job.status();
    return (*job)->Get();
  }
  absl::StatusOr<v1::ListSolveJobsResponse> List(const Identity& caller,
                                                 const v1::ListSolveJobsRequest& request) {
    absl::StatusOr<Page<std::shared_ptr<Job>>> page =
        coordinator_->jobs().List(request.page_size(), request.page_token(), caller);
    if (!page.ok()) return page.status();
    v1::ListSolveJobsResponse response;
    for (const std::shared_ptr<Job>& job : page->items) *response.add_solve_jobs() = job->Get();
    response.set_next_page_token(page->next_page_token);
    return response;
  }

  Coordinator* const coordinator_;
  const Doors& doors_;
};

}  // namespace

std::unique_ptr<grpc::Service> MakeSolveJobService(Coordinator* coordinator, const Doors* doors) {
  return std::make_unique<SolveJobService>(coordinator, doors);
}

}  // namespace lambert::server
