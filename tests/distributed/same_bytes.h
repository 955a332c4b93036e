// The bytes that farms in trouble must come to: those of the loop in one thread.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "tests/distributed/serial_solution.h"
#include "tests/service/service_calls.h"

namespace lambert {

inline constexpr int64_t kRays = 3'000'000;  // about a second of one core

inline std::string SolveSerially(Method method, int64_t rays = kRays) {
  SolveOptions options;
  options.shoot.method = method;
  if (method == Method::kImportance) options.shoot.region = {"0"};
  options.max_rays = rays;
  return SolveSerially(options);
}

inline const std::string& ExpectedBytes() {
  static const std::string bytes = SolveSerially(Method::kAuto);
  return bytes;
}

inline void ExpectSameBytes(const ServiceCalls::Watched& watched,
                            const std::string& expected = ExpectedBytes()) {
  EXPECT_TRUE(watched.status.ok()) << watched.status.error_message();
  EXPECT_EQ(watched.ended.state(), v1::SolveJob::STATE_SUCCEEDED)
      << watched.ended.error().message();
  EXPECT_TRUE(watched.payload == expected);
}

}  // namespace lambert
