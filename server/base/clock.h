// Where the coordinator reads the time, so that tests can set it.
#pragma once

#include <chrono>
#include <functional>

namespace lambert::server {

using TimePoint = std::chrono::steady_clock::time_point;
using Duration = std::chrono::steady_clock::duration;
using Clock = std::function<TimePoint()>;

inline TimePoint SteadyNow() { return std::chrono::steady_clock::now(); }

inline double ToSeconds(Duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace lambert::server
