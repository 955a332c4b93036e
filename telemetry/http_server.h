// What a program shows over HTTP of how it is doing. Anyone who reaches the address may read it.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "absl/status/statusor.h"

namespace lambert {

// Called on threads of the server, several at a time.
struct HttpPages {
  std::function<std::string()> metrics;  // GET /metrics, for Prometheus
  std::function<bool()> is_ready;        // GET /readyz: 200, or 503 while it is false
};                                       // GET /healthz: 200 while the program answers at all

class HttpServer {
 public:
  // `listen`: HOST:PORT, port 0 for any. UNAVAILABLE (ADDRESS_IN_USE) where it cannot be had. What
  // the pages use has to outlive the server.
  static absl::StatusOr<std::unique_ptr<HttpServer>> Start(const std::string& listen,
                                                           HttpPages pages);
  virtual ~HttpServer() = default;

  // HOST:PORT with the real port.
  virtual std::string address() const = 0;
};

}  // namespace lambert
