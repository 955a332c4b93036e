#include "client/channel.h"

#include "grpcpp/create_channel.h"
#include "grpcpp/security/credentials.h"
#include "radiosity/core/error.h"

namespace lambert::client {
namespace {

// Without pings a client of a frozen or partitioned server waits for ever. The server has to allow
// this interval, also for a stream on which nothing flows.
constexpr int kKeepaliveInterval_ms = 2000;
constexpr int kKeepaliveTimeout_ms = 3000;
constexpr int kReconnectPause_ms = 100;
constexpr int kLongestReconnectPause_ms = 2000;

grpc::ChannelArguments Arguments() {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, kKeepaliveInterval_ms);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, kKeepaliveTimeout_ms);
  arguments.SetInt(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, kReconnectPause_ms);
  arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, kReconnectPause_ms);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, kLongestReconnectPause_ms);
  // Calls are repeated by Caller, which says so; gRPC would do it silently.
  arguments.SetInt(GRPC_ARG_ENABLE_RETRIES, 0);
  return arguments;
}

// A server that does not speak TLS looks like none, and so does one that speaks nothing else.
absl::Status Unreachable(const std::string& server, const std::string& message, bool has_tls) {
  return MakeError(
      absl::StatusCode::kUnavailable,
      {"SERVER_UNREACHABLE", server, message,
       "start it with lambert-server --listen " + server +
           (has_tls ? ", see whether --tls-ca fits it" : ", give --tls-ca where it speaks TLS") +
           ", or leave out --server to solve in this process"});
}

}  // namespace

absl::StatusOr<std::shared_ptr<grpc::Channel>> Connect(const std::string& server,
                                                       std::chrono::duration<double> timeout,
                                                       const CredentialFiles& credentials) {
  auto made = MakeChannelCredentials(server, credentials);
  if (!made.ok()) return made.status();
  const bool has_tls = !credentials.tls_ca.empty();
  auto channel = grpc::CreateCustomChannel(server, *made, Arguments());
  const auto deadline = std::chrono::system_clock::now() +
                        std::chrono::duration_cast<std::chrono::microseconds>(timeout);
  for (auto state = channel->GetState(true); state != GRPC_CHANNEL_READY;
       state = channel->GetState(true)) {
    if (state == GRPC_CHANNEL_TRANSIENT_FAILURE || state == GRPC_CHANNEL_SHUTDOWN) {
      return Unreachable(server, "no server answers there", has_tls);
    }
    if (!channel->WaitForStateChange(state, deadline)) {
      return Unreachable(server, "no server answered in time", has_tls);
    }
  }
  return channel;
}

}  // namespace lambert::client
