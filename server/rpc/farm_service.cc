#include "lambert/v1/farm_service.grpc.pb.h"

#include <map>
#include <memory>
#include <string>
#include <utility>

#include "server/base/pages.h"
#include "server/coordinator.h"
#include "server/rpc/reply.h"
#include "server/rpc/services.h"

namespace lambert::server {
namespace {

class FarmService : public v1::FarmService::CallbackService {
 public:
  FarmService(Coordinator* coordinator, const Doors* doors)
      : coordinator_(coordinator), doors_(*doors) {}

  grpc::ServerUnaryReactor* ListWorkers(grpc::CallbackServerContext* context,
                                        const v1::ListWorkersRequest* request,
                                        v1::ListWorkersResponse* response) override {
    return Answer(context, doors_, Guests::kClients, response,
                  [&](const Identity&) { return List(*request); });
  }

 private:
  absl::StatusOr<v1::ListWorkersResponse> List(const v1::ListWorkersRequest& request) {
    std::map<std::string, v1::Worker> workers;
    for (const WorkerInfo& info : coordinator_->work().ListWorkers()) {
      v1::Worker worker;
      worker.set_name("workers/" + info.worker_id);
      worker.set_slot_count(info.slots);
      worker.set_lease_count(info.leases);
      worker.set_finished_unit_count(info.finished_units);
      worker.set_silence_seconds(info.silence_s);
      workers[worker.name()] = std::move(worker);
    }
    absl::StatusOr<Page<v1::Worker>> page =
        TakePage(workers, request.page_size(), request.page_token());
    if (!page.ok()) return page.status();
    v1::ListWorkersResponse response;
    for (v1::Worker& worker : page->items) *response.add_workers() = std::move(worker);
    response.set_next_page_token(page->next_page_token);
    return response;
  }

  Coordinator* const coordinator_;
  const Doors& doors_;
};

}  // namespace

std::unique_ptr<grpc::Service> MakeFarmService(Coordinator* coordinator, const Doors* doors) {
  return std::make_unique<FarmService>(coordinator, doors);
}

}  // namespace lambert::server
