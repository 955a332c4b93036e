// A call of any method with any bytes as its one message.
#pragma once

#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/grpcpp.h>

#include <chrono>
#include <string>

namespace lambert {

// What becomes of it in `patience`; `authorization` "": none is sent. What is answered is dropped.
inline grpc::Status CallRaw(grpc::GenericStub& stub, const std::string& method,
                            const std::string& body, const std::string& authorization,
                            std::chrono::seconds patience) {
  grpc::ClientContext context;
  if (!authorization.empty()) context.AddMetadata("authorization", authorization);
  context.set_deadline(std::chrono::system_clock::now() + patience);
  grpc::CompletionQueue queue;
  auto next = [&queue] {
    void* tag = nullptr;
    bool ok = false;
    return queue.Next(&tag, &ok) && ok;
  };
  auto call = stub.PrepareCall(&context, method, &queue);
  call->StartCall(nullptr);
  next();
  const grpc::Slice slice(body);
  call->WriteLast(grpc::ByteBuffer(&slice, 1), {}, nullptr);
  next();
  grpc::ByteBuffer response;
  do call->Read(&response, nullptr);
  while (next());
  grpc::Status status;
  call->Finish(&status, nullptr);
  next();
  return status;
}

}  // namespace lambert
