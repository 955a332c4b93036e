#include <memory>
#include <utility>

#include "lambert/v1/gather_service.grpc.pb.h"
#include "server/coordinator.h"
#include "server/rpc/reply.h"
#include "server/rpc/services.h"

namespace lambert::server {
namespace {

class GatherService : public v1::GatherService::CallbackService {
 public:
  GatherService(Coordinator* coordinator, const Doors* doors)
      : coordinator_(coordinator), doors_(*doors) {}

  grpc::ServerUnaryReactor* CreateGather(grpc::CallbackServerContext* context,
                                         const v1::CreateGatherRequest* request,
                                         v1::Gather* response) override {
    const absl::StatusOr<Identity> caller = doors_.Admit(*context, Guests::kClients);
    if (!caller.ok()) return Reply(context, caller.status());
    grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
    coordinator_->pool().Run([this, caller = *caller, reactor, request, response] {
      absl::StatusOr<v1::Gather> gather = coordinator_->gathers().Create(caller, *request);
      if (gather.ok()) *response = *std::move(gather);
      reactor->Finish(ToGrpc(gather.status()));
    });
    return reactor;
  }
  grpc::ServerUnaryReactor* GetGather(grpc::CallbackServerContext* context,
                                      const v1::GetGatherRequest* request,
                                      v1::Gather* response) override {
    return Answer(context, doors_, Guests::kClients, response, [&](const Identity& caller) {
      return coordinator_->gathers().Get(caller, request->name());
    });
  }

 private:
  Coordinator* const coordinator_;
  const Doors& doors_;
};

}  // namespace

std::unique_ptr<grpc::Service> MakeGatherService(Coordinator* coordinator, const Doors* doors) {
  return std::make_unique<GatherService>(coordinator, doors);
}

}  // namespace lambert::server
