// Durations as messages hold them.
#pragma once

#include <chrono>

#include "google/protobuf/duration.pb.h"
#include "google/protobuf/util/time_util.h"
#include "server/base/clock.h"

namespace lambert::server {

inline google::protobuf::Duration ToProto(Duration duration) {
  return google::protobuf::util::TimeUtil::NanosecondsToDuration(
      std::chrono::duration_cast<std::chrono::nanoseconds>(duration).count());
}

}  // namespace lambert::server
