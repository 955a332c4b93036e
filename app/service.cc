#include "app/service.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "client/channel.h"

namespace lambert::app {
namespace {

constexpr std::chrono::duration<double> kConnectTimeout{10};

}  // namespace

int ThreadsPerWorker(const Options& options) {
  if (options.threads > 0) return options.threads;
  const int processors = static_cast<int>(std::thread::hardware_concurrency());
  return std::max(1, processors / options.workers);
}

absl::StatusOr<Service> OpenService(const Options& options,
                                    std::function<void(const std::string&)> on_notice) {
  Service service;
  client::ClientOptions client_options;
  client_options.patience = std::chrono::duration<double>(options.reconnect_s);
  client_options.on_notice = std::move(on_notice);
  std::shared_ptr<grpc::Channel> channel;
  if (options.server.empty()) {
    auto local = LocalService::Start({.workers = options.workers,
                                      .threads_per_worker = ThreadsPerWorker(options),
                                      .limits = options.limits,
                                      .max_patches = options.patch.max_patches});
    if (!local.ok()) return local.status();
    service.local = *std::move(local);
    channel = service.local->channel();
  } else {
    auto connected = client::Connect(options.server, kConnectTimeout, options.credentials);
    if (!connected.ok()) return connected.status();
    channel = *std::move(connected);
    client_options.server = options.server;
  }
  service.client = std::make_unique<client::Client>(std::move(channel), std::move(client_options));
  return service;
}

}  // namespace lambert::app
