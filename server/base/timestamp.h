// The wall clock, as it stands in resources.
#pragma once

#include <chrono>

#include "google/protobuf/timestamp.pb.h"
#include "google/protobuf/util/time_util.h"

namespace lambert::server {

// Now, to the microsecond.
inline google::protobuf::Timestamp TimestampNow() {
  const auto since_1970 = std::chrono::system_clock::now().time_since_epoch();
  return google::protobuf::util::TimeUtil::MicrosecondsToTimestamp(
      std::chrono::duration_cast<std::chrono::microseconds>(since_1970).count());
}

}  // namespace lambert::server
