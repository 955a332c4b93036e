#include "client/caller.h"

#include <algorithm>
#include <utility>

#include "client/status.h"
#include "fmt/format.h"
#include "radiosity/core/error.h"

namespace lambert::client {
namespace {

constexpr std::chrono::duration<double> kFirstPause{0.1};
constexpr std::chrono::duration<double> kLongestPause{2.0};

// A call that nobody here cancelled was cut off by a server that goes.
bool IsAway(const grpc::Status& status) {
  return status.error_code() == grpc::StatusCode::UNAVAILABLE ||
         status.error_code() == grpc::StatusCode::DEADLINE_EXCEEDED ||
         status.error_code() == grpc::StatusCode::CANCELLED;
}

}  // namespace

Caller::Caller(std::string server, std::chrono::duration<double> patience,
               std::function<void(const std::string&)> on_notice)
    : server_(std::move(server)), patience_(patience), on_notice_(std::move(on_notice)) {}

absl::Status Caller::Call(const std::string& where, std::chrono::duration<double> deadline,
                          const std::function<grpc::Status(grpc::ClientContext&)>& attempt,
                          const std::string& hint) {
  while (true) {
    const grpc::Status status = RunOnce(deadline, attempt);
    {
      std::lock_guard lock(mutex_);
      if (aborted_) {
        return MakeError(absl::StatusCode::kCancelled,
                         {"INTERRUPTED", where, "stopped by hand", "run the command again"});
      }
    }
    if (!IsAway(status)) {
      Reached();
      return FromGrpc(status, where);
    }
    if (!WaitForNext(status)) {
      return MakeError(absl::StatusCode::kUnavailable,
                       {"SERVER_UNREACHABLE", server_,
                        fmt::format("the server is away ({})", status.error_message()), hint});
    }
  }
}

grpc::Status Caller::RunOnce(std::chrono::duration<double> deadline,
                             const std::function<grpc::Status(grpc::ClientContext&)>& attempt) {
  grpc::ClientContext context;
  if (deadline.count() > 0) {
    context.set_deadline(std::chrono::system_clock::now() +
                         std::chrono::duration_cast<std::chrono::microseconds>(deadline));
  }
  {
    std::lock_guard lock(mutex_);
    if (aborted_) return grpc::Status::CANCELLED;
    running_.insert(&context);
  }
  grpc::Status status = attempt(context);
  std::lock_guard lock(mutex_);
  running_.erase(&context);
  return status;
}

bool Caller::WaitForNext(const grpc::Status& failure) {
  std::unique_lock lock(mutex_);
  const Clock::time_point now = Clock::now();
  if (!lost_) {
    lost_ = true;
    lost_since_ = now;
    pause_ = kFirstPause;
    lock.unlock();
    on_notice_(fmt::format("lost {} ({}); trying again for {:.0f} s", server_,
                           failure.error_message(), patience_.count()));
    lock.lock();
  }
  if (now - lost_since_ >= patience_) return false;
  aborted_changed_.wait_for(lock, pause_, [this] { return aborted_; });
  pause_ = std::min(pause_ * 2, kLongestPause);
  return true;
}

void Caller::Reached() {
  {
    std::lock_guard lock(mutex_);
    if (!std::exchange(lost_, false)) return;
  }
  on_notice_("back at " + server_);
}

void Caller::Abort() {
  std::lock_guard lock(mutex_);
  aborted_ = true;
  for (grpc::ClientContext* context : running_) context->TryCancel();
  aborted_changed_.notify_all();
}

}  // namespace lambert::client
