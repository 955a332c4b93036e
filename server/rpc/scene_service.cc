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
  explicit SceneService(Coordinator* coordinator) : coordinator_(coordinator) {}

  grpc::ServerUnaryReactor* CreateScene(grpc::CallbackServerContext* context,
                                        const v1::CreateSceneRequest* request,
                                        v1::Scene* response) override {
    grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
    coordinator_->pool().Run([this, reactor, request, response] {
      absl::StatusOr<v1::Scene> scene = coordinator_->scenes().Create(*request);
      if (scene.ok()) *response = *std::move(scene);
      reactor->Finish(ToGrpc(scene.status()));
    });
    return reactor;
  }
  grpc::ServerUnaryReactor* GetScene(grpc::CallbackServerContext* context,
                                     const v1::GetSceneRequest* request,
                                     v1::Scene* response) override {
    return Reply(context, coordinator_->scenes().Get(request->name()), response);
  }
  grpc::ServerUnaryReactor* ListScenes(grpc::CallbackServerContext* context,
                                       const v1::ListScenesRequest* request,
                                       v1::ListScenesResponse* response) override {
    absl::StatusOr<Page<v1::Scene>> page =
        coordinator_->scenes().List(request->page_size(), request->page_token());
    if (!page.ok()) return Reply(context, page.status());
    for (v1::Scene& scene : page->items) *response->add_scenes() = std::move(scene);
    response->set_next_page_token(page->next_page_token);
    return Reply(context, absl::OkStatus());
  }
  grpc::ServerUnaryReactor* DeleteScene(grpc::CallbackServerContext* context,
                                        const v1::DeleteSceneRequest* request,
                                        google::protobuf::Empty*) override {
    return Reply(context, coordinator_->DeleteScene(request->name()));
  }

 private:
  Coordinator* const coordinator_;
};

}  // namespace

std::unique_ptr<grpc::Service> MakeSceneService(Coordinator* coordinator) {
  return std::make_unique<SceneService>(coordinator);
}

}  // namespace lambert::server
