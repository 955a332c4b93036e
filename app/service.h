// The service that a command talks to: a server, or all of it in this process.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "app/options.h"
#include "client/client.h"
#include "local/local_service.h"

namespace lambert::app {

// Threads of each worker in this process, where the user did not say: the processor's, shared out.
int ThreadsPerWorker(const Options& options);

struct Service {
  std::unique_ptr<LocalService> local;     // null with --server
  std::unique_ptr<client::Client> client;  // goes before `local` does
};

// Connects to options.server, or starts the whole service in this process where none is given.
// `on_notice`: see ClientOptions.
absl::StatusOr<Service> OpenService(const Options& options,
                                    std::function<void(const std::string&)> on_notice);

}  // namespace lambert::app
