// One call after the other to a server that may be away for a while.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <set>
#include <string>

#include "absl/status/status.h"
#include "grpcpp/client_context.h"
#include "grpcpp/support/status.h"

namespace lambert::client {

// Repeats calls that failed because the server could not be reached, with growing pauses, until it
// has been away for `patience`. Any thread; several calls at a time.
class Caller {
 public:
  // `server` names it in messages; `on_notice` is told when it is lost and when it is back.
  Caller(std::string server, std::chrono::duration<double> patience,
         std::function<void(const std::string&)> on_notice);

  // Runs `attempt` until it succeeds, fails for another reason than reachability, or patience ends:
  // then UNAVAILABLE with reason SERVER_UNREACHABLE, whose hint is `hint`. `attempt` must be safe
  // to repeat. An attempt that made headway (`Reached` was called in it) gets all the patience
  // again; one that cancels itself must not say so, as only a server that goes does. After Abort:
  // CANCELLED, reason INTERRUPTED. `where` names what the call is about.
  absl::Status Call(const std::string& where, std::chrono::duration<double> deadline,
                    const std::function<grpc::Status(grpc::ClientContext&)>& attempt,
                    const std::string& hint = "start the server, or give another --server");

  // From an attempt that lasts: the server has answered.
  void Reached();

  // Makes the calls in progress and all later ones fail at once.
  void Abort();

  const std::string& server() const { return server_; }

 private:
  using Clock = std::chrono::steady_clock;
  // The status of one attempt, which Abort can end.
  grpc::Status RunOnce(std::chrono::duration<double> deadline,
                       const std::function<grpc::Status(grpc::ClientContext&)>& attempt);
  // Waits before the next attempt; false where patience is at its end.
  bool WaitForNext(const grpc::Status& failure);

  const std::string server_;
  const std::chrono::duration<double> patience_;
  const std::function<void(const std::string&)> on_notice_;

  std::mutex mutex_;  // guards all below
  std::condition_variable aborted_changed_;
  bool aborted_ = false;
  std::set<grpc::ClientContext*> running_;
  bool lost_ = false;
  Clock::time_point lost_since_;
  std::chrono::duration<double> pause_{};
};

}  // namespace lambert::client
