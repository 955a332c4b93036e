// A connection to a server.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "net/credentials.h"

namespace grpc {
class Channel;
}

namespace lambert::client {

// Connects to "HOST:PORT" and waits until the server answers. A server that stops answering later
// is noticed in a few seconds by keepalive pings, and the channel connects again by itself. Fails
// with UNAVAILABLE, reason SERVER_UNREACHABLE, as soon as the connection is refused, or after
// `timeout`; and as MakeChannelCredentials does.
absl::StatusOr<std::shared_ptr<grpc::Channel>> Connect(const std::string& server,
                                                       std::chrono::duration<double> timeout,
                                                       const CredentialFiles& credentials = {});

}  // namespace lambert::client
