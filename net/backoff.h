// Waits between attempts: longer each time, and never the same on two machines.
#pragma once

#include <algorithm>
#include <random>

#include "absl/synchronization/notification.h"
#include "absl/time/time.h"

namespace lambert {

class Backoff {
 public:
  // Sleeps, at most until `stop` is notified.
  void Sleep(const absl::Notification& stop) {
    const double jitter = std::uniform_real_distribution<double>(0.5, 1.0)(random_);
    stop.WaitForNotificationWithTimeout(delay_ * jitter);
    delay_ = std::min(delay_ * 2, kLongest);
  }
  void Reset() { delay_ = kShortest; }

 private:
  static constexpr absl::Duration kShortest = absl::Milliseconds(100);
  static constexpr absl::Duration kLongest = absl::Seconds(3);
  absl::Duration delay_ = kShortest;
  std::minstd_rand random_{std::random_device{}()};
};

}  // namespace lambert
