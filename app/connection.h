// A command's connection to its service, which Ctrl-C cuts off.
#pragma once

#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "app/interrupt.h"
#include "app/service.h"

namespace lambert::app {

// A client whose calls the first Ctrl-C ends; the jobs on the server go on.
class Connection {
 public:
  static absl::StatusOr<std::unique_ptr<Connection>> Open(
      const Options& options, Interrupt& interrupt,
      std::function<void(const std::string&)> on_notice = [](const std::string& notice) {
        std::fprintf(stderr, "%s\n", notice.c_str());
      }) {
    auto service = OpenService(options, std::move(on_notice));
    if (!service.ok()) return service.status();
    return std::unique_ptr<Connection>(new Connection(*std::move(service), interrupt));
  }
  ~Connection() { interrupt_.OnFirst(nullptr); }
  client::Client& client() { return *service_.client; }

 private:
  Connection(Service service, Interrupt& interrupt)
      : service_(std::move(service)), interrupt_(interrupt) {
    interrupt_.OnFirst([this] { service_.client->Abort(); });
  }
  Service service_;
  Interrupt& interrupt_;
};

}  // namespace lambert::app
