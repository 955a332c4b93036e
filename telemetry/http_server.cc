#include "telemetry/http_server.h"

#include <CivetServer.h>

#include <utility>

#include "radiosity/core/error.h"

namespace lambert {
namespace {

constexpr char kText[] = "text/plain; charset=utf-8";
constexpr char kMetrics[] = "text/plain; version=0.0.4; charset=utf-8";

bool Answer(mg_connection* connection, int code, const char* type, const std::string& body) {
  mg_printf(connection, "HTTP/1.1 %d %s\r\nContent-Type: %s\r\nContent-Length: %zu\r\n\r\n", code,
            mg_get_response_code_text(connection, code), type, body.size());
  mg_write(connection, body.data(), body.size());
  return true;
}

// GET of one path.
class Page : public CivetHandler {
 public:
  explicit Page(std::function<bool(mg_connection*)> answer) : answer_(std::move(answer)) {}
  bool handleGet(CivetServer*, mg_connection* connection) override { return answer_(connection); }

 private:
  const std::function<bool(mg_connection*)> answer_;
};

class HttpServerImpl : public HttpServer {
 public:
  HttpServerImpl(const std::string& listen, HttpPages pages)
      : metrics_([make = std::move(pages.metrics)](mg_connection* connection) {
          return Answer(connection, 200, kMetrics, make());
        }),
        ready_([is_ready = std::move(pages.is_ready)](mg_connection* connection) {
          return is_ready() ? Answer(connection, 200, kText, "ready\n")
                            : Answer(connection, 503, kText, "not ready\n");
        }),
        healthy_([](mg_connection* connection) { return Answer(connection, 200, kText, "ok\n"); }),
        server_(std::vector<std::string>{"listening_ports", listen, "num_threads", "2",
                                         "request_timeout_ms", "5000"}) {
    server_.addHandler("/metrics$", metrics_);
    server_.addHandler("/readyz$", ready_);
    server_.addHandler("/healthz$", healthy_);
    address_ = listen.substr(0, listen.rfind(':') + 1) +
               std::to_string(server_.getListeningPorts().front());
  }
  ~HttpServerImpl() override { server_.close(); }
  std::string address() const override { return address_; }

 private:
  Page metrics_, ready_, healthy_;
  CivetServer server_;
  std::string address_;
};

}  // namespace

absl::StatusOr<std::unique_ptr<HttpServer>> HttpServer::Start(const std::string& listen,
                                                              HttpPages pages) try {
  return std::make_unique<HttpServerImpl>(listen, std::move(pages));
} catch (const CivetException&) {
  return MakeError(absl::StatusCode::kUnavailable,
                   {"ADDRESS_IN_USE", listen, "metrics cannot be served there",
                    "choose another --http HOST:PORT"});
}

}  // namespace lambert
