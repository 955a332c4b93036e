#include "telemetry/http_server.h"

#include <gtest/gtest.h>

#include <atomic>

#include "tests/support/http_get.h"

namespace lambert {
namespace {

TEST(HttpServer, ShowsMetricsHealthAndReadiness) {
  std::atomic<bool> is_ready{false};
  auto server = HttpServer::Start("127.0.0.1:0", {[] { return std::string("lambert_rays 1\n"); },
                                                  [&] { return is_ready.load(); }});
  ASSERT_TRUE(server.ok()) << server.status();
  const std::string address = (*server)->address();
  const std::string metrics = HttpGet(address, "/metrics");
  EXPECT_EQ(metrics.find("HTTP/1.1 200"), 0u) << metrics;
  EXPECT_NE(metrics.find("\r\n\r\nlambert_rays 1\n"), std::string::npos) << metrics;
  EXPECT_EQ(HttpGet(address, "/healthz").find("HTTP/1.1 200"), 0u);
  EXPECT_EQ(HttpGet(address, "/readyz").find("HTTP/1.1 503"), 0u);
  is_ready = true;
  EXPECT_EQ(HttpGet(address, "/readyz").find("HTTP/1.1 200"), 0u);
}

TEST(HttpServer, ShowsNothingElse) {
  auto server =
      HttpServer::Start("127.0.0.1:0", {[] { return std::string(); }, [] { return true; }});
  ASSERT_TRUE(server.ok()) << server.status();
  for (const char* path : {"/", "/metrics/more", "/../CMakeLists.txt", "/etc/passwd"}) {
    const std::string answer = HttpGet((*server)->address(), path);
    EXPECT_NE(answer.find("HTTP/1.1 "), std::string::npos) << path;
    EXPECT_EQ(answer.find("HTTP/1.1 200"), std::string::npos) << path;
  }
}

TEST(HttpServer, SaysWhereItCannotListen) {
  const HttpPages pages = {[] { return std::string(); }, [] { return true; }};
  auto first = HttpServer::Start("127.0.0.1:0", pages);
  ASSERT_TRUE(first.ok()) << first.status();
  auto second = HttpServer::Start((*first)->address(), pages);
  EXPECT_EQ(second.status().code(), absl::StatusCode::kUnavailable);
  EXPECT_NE(second.status().message().find((*first)->address()), absl::string_view::npos);
}

}  // namespace
}  // namespace lambert
