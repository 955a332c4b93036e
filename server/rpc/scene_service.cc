#include <memory>
#include <utility>

#include "lambert/v1/scene_service.grpc.pb.h"
#include "server/coordinator.h"
#include "server/rpc/reply.h"
#include "server/rpc/services.h"

namespace lambert::server {
namespace {

class SceneService : public v1::SceneService::CallbackService {
 public:
  SceneService(Coordinator* coordinator, const Doors* doors)
      : coordinator_(coordinator), doors_(*doors) {}

  grpc::ServerUnaryReactor* CreateScene(grpc::CallbackServerContext* context,
                                        const v1::CreateSceneRequest* request,
                                        v1::Scene* response) override {
    const absl::StatusOr<Identity> caller = doors_.Admit(*context, Guests::kClients);
    if (!caller.ok()) return Reply(context, caller.status());
    grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
    coordinator_->pool().Run([this, caller = *caller, reactor, request, response] {
      absl::StatusOr<v1::Scene> scene = coordinator_->holdings().CreateScene(caller, *request);
      if (scene.ok()) *response = *std::move(scene);
      reactor->Finish(ToGrpc(scene.status()));
    });
    return reactor;
  }
  grpc::ServerUnaryReactor* GetScene(grpc::CallbackServerContext* context,
                                     const v1::GetSceneRequest* request,
                                     v1::Scene* response) override {
    return Answer(context, doors_, Guests::kClients, response, [&](const Identity& caller) {
      return coordinator_->scenes().Get(request->name(), caller);
    });
  }
  grpc::ServerUnaryReactor* ListScenes(grpc::CallbackServerContext* context,
                                       const v1::ListScenesRequest* request,
                                       v1::ListScenesResponse* response) override {
    return Answer(context, doors_, Guests::kClients, response,
                  [&](const Identity& caller) { return List(caller, *request); });
  }
  grpc::ServerUnaryReactor* DeleteScene(grpc::CallbackServerContext* context,
                                        const v1::DeleteSceneRequest* request,
                                        google::protobuf::Empty*) override {
    return Answer(context, doors_, Guests::kClients, [&](const Identity& caller) {
      return coordinator_->DeleteScene(caller, request->name());
    });
  }

 private:
  absl::StatusOr<v1::ListScenesResponse> List(const Identity& caller,
                                              const v1::ListScenesRequest& request) {
    absl::StatusOr<Page<v1::Scene>> page =
        coordinator_->scenes().List(request.page_size(), request.page_token(), caller);
    if (!page.ok()) return page.status();
    v1::ListScenesResponse response;
    for (v1::Scene& scene : page->items) *response.add_scenes() = std::move(scene);
    response.set_next_page_token(page->next_page_token);
    return response;
  }

  Coordinator* const coordinator_;
  const Doors& doors_;
};

}  // namespace

std::unique_ptr<grpc::Service> MakeSceneService(Coordinator* coordinator, const Doors* doors) {
  return std::make_unique<SceneService>(coordinator, doors);
}

}  // namespace lambert::server
