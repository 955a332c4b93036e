// A channel of a program that works for a server: a worker, or a merge shard.
#pragma once

#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "net/credentials.h"

namespace grpc {
class Channel;
}

namespace lambert {

// To HOST:PORT, with keepalive, and messages large enough for any grant. Fails as
// MakeChannelCredentials does.
absl::StatusOr<std::shared_ptr<grpc::Channel>> ConnectToServer(
    const std::string& address, const CredentialFiles& credentials = {});

}  // namespace lambert
