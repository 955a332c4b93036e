// Calls with any bodies in any order, through the services of a coordinator. An input is a list of
// messages: a byte that picks the method, two bytes of size, the body. Streamed calls take the
// messages of their method that follow each other as one stream.
#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "server/coordinator.h"
#include "server/rpc/rpc_server.h"
#include "tests/fuzz/fuzz.h"
#include "tests/service/rpc_methods.h"

namespace lambert {
namespace {

struct Service {
  Service() {
    server::CoordinatorOptions options;
    options.max_store_bytes = 64 << 20;
    options.max_patches = 2000;
    options.scene = {.bytes = 1 << 20,
                     .triangles = 2000,
                     .instances = 1000,
                     .image_pixels = 1 << 16,
                     .total_pixels = 1 << 18};
    options.work.sync_interval = std::chrono::milliseconds(1);
    coordinator = *server::Coordinator::Start(options);
    // Over a socket: gRPC's in-process transport keeps memory of calls that are made step by step.
    rpc = *server::RpcServer::Start(coordinator.get(), "127.0.0.1:0");
    stub = std::make_unique<grpc::GenericStub>(
        grpc::CreateChannel(rpc->address(), grpc::InsecureChannelCredentials()));
  }
  std::unique_ptr<server::Coordinator> coordinator;
  std::unique_ptr<server::RpcServer> rpc;
  std::unique_ptr<grpc::GenericStub> stub;
};

// One call with these bodies, to its end or for a tenth of a second. A status has to come.
void Call(Service& service, const std::string& method, const std::vector<std::string>& bodies) {
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::milliseconds(100));
  grpc::CompletionQueue queue;
  auto next = [&queue] {
    void* tag = nullptr;
    bool ok = false;
    return queue.Next(&tag, &ok) && ok;
  };
  auto call = service.stub->PrepareCall(&context, method, &queue);
  call->StartCall(nullptr);
  bool open = next();
  for (size_t i = 0; open && i < bodies.size(); ++i) {
    const grpc::Slice slice(bodies[i]);
    call->Write(grpc::ByteBuffer(&slice, 1), nullptr);
    open = next();
  }
  if (open) {
    call->WritesDone(nullptr);
    open = next();
  }
  grpc::ByteBuffer response;
  while (open) {
    call->Read(&response, nullptr);
    open = next();
  }
  grpc::Status status;
  call->Finish(&status, nullptr);
  Expect(next(), "every call ends with a status");
  queue.Shutdown();
  Expect(status.error_code() != grpc::StatusCode::UNKNOWN, "no handler throws");
}

}  // namespace

void FuzzOne(const std::string& bytes) {
  static Service& service = *new Service;
  static const auto& methods =
      *new std::vector<const google::protobuf::MethodDescriptor*>(AllRpcMethods());
  constexpr size_t kHeader = 3;
  std::vector<std::string> bodies;
  for (size_t at = 0; at + kHeader <= bytes.size();) {
    const auto byte = [&](size_t i) { return static_cast<unsigned char>(bytes[at + i]); };
    const unsigned char picked = byte(0);
    const size_t size = byte(1) + 256u * byte(2);
    bodies.push_back(bytes.substr(at + kHeader, size));
    at += kHeader + bodies.back().size();
    const bool goes_on =
        at + kHeader <= bytes.size() && static_cast<unsigned char>(bytes[at]) == picked;
    if (goes_on) continue;
    Call(service, PathOf(*methods[picked % methods.size()]), bodies);
    bodies.clear();
  }
}

}  // namespace lambert
