// What every handler ends with: a result becomes a response or a status.
#pragma once

#include <grpcpp/grpcpp.h>

#include <utility>

#include "absl/status/statusor.h"
#include "google/protobuf/empty.pb.h"
#include "server/base/status_proto.h"
#include "server/doors/doors.h"

namespace lambert::server {

// The status with its details, as gRPC sends it.
grpc::Status ToGrpc(const absl::Status& status);

template <typename T>
grpc::ServerUnaryReactor* Reply(grpc::CallbackServerContext* context, absl::StatusOr<T> result,
                                T* response) {
  if (result.ok()) *response = *std::move(result);
  grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
  reactor->Finish(ToGrpc(result.status()));
  return reactor;
}

inline grpc::ServerUnaryReactor* Reply(grpc::CallbackServerContext* context,
                                       const absl::Status& status) {
  grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
  reactor->Finish(ToGrpc(status));
  return reactor;
}

// A unary handler for `guests`: what `call` makes of who calls, a StatusOr<T>.
template <typename T, typename Call>
grpc::ServerUnaryReactor* Answer(grpc::CallbackServerContext* context, const Doors& doors,
                                 Guests guests, T* response, const Call& call) {
  const absl::StatusOr<Identity> caller = doors.Admit(*context, guests);
  return Reply(context, caller.ok() ? absl::StatusOr<T>(call(*caller)) : caller.status(), response);
}

// The same for a response without content: `call` returns a Status.
template <typename Call>
grpc::ServerUnaryReactor* Answer(grpc::CallbackServerContext* context, const Doors& doors,
                                 Guests guests, const Call& call) {
  const absl::StatusOr<Identity> caller = doors.Admit(*context, guests);
  return Reply(context, caller.ok() ? call(*caller) : caller.status());
}

// A stream that ends before it began.
template <typename Reactor>
class Refused : public Reactor {
 public:
  explicit Refused(const absl::Status& status) { this->Finish(ToGrpc(status)); }
  void OnDone() override { delete this; }
};

}  // namespace lambert::server
