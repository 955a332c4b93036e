// What a merge shard says to its coordinator: that it is there, and the sums of steps.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"
#include "absl/synchronization/notification.h"
#include "absl/time/time.h"
#include "radiosity/core/log.h"
#include "server/merge/merge_shard.h"

namespace grpc {
class Channel;
}

namespace lambert::server {

struct ShardSessionOptions {
  std::string name;     // never used before: what parts are addressed to
  std::string address;  // HOST:PORT at which workers reach the shard
  Log log = [](const LogLine&) {};
  // The coordinator will never take this shard (another unit version, a wrong token); any thread.
  std::function<void(const absl::Status&)> on_refused = [](const absl::Status&) {};
};

// Keeps the shard's steps those that the coordinator asks for, and hands over what is whole, on two
// threads. A coordinator that goes away is tried again, for ever.
class ShardSession {
 public:
  // `shard` outlives the session, which opens and closes it.
  ShardSession(std::shared_ptr<grpc::Channel> channel, MergeShard* shard,
               const ShardSessionOptions& options);
  ~ShardSession();

  // Says that the shard leaves. Blocks until no step needs it, or `grace` has passed.
  void Drain(absl::Duration grace);

 private:
  class Calls;
  void Follow();
  void HandOver();
  void HandOver(const MergedRange& range);

  const ShardSessionOptions options_;
  MergeShard* const shard_;
  const std::unique_ptr<Calls> calls_;
  absl::Notification draining_, ended_;
  std::thread follower_, deliverer_;
};

}  // namespace lambert::server
