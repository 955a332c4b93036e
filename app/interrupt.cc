#include "app/interrupt.h"

#include <unistd.h>

#include <csignal>
#include <utility>

#include "app/exit.h"

namespace lambert::app {
namespace {

sigset_t StopSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  return signals;
}

}  // namespace

Interrupt::Interrupt() {
  // A shell starts background programs with SIGINT ignored, and what is ignored cannot be waited
  // for.
  std::signal(SIGINT, SIG_DFL);
  const sigset_t signals = StopSignals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  thread_ = std::thread([this] { Wait(); });
}

Interrupt::~Interrupt() {
  stopping_ = true;
  pthread_kill(thread_.native_handle(), SIGTERM);
  thread_.join();
}

void Interrupt::OnFirst(std::function<void()> action) {
  std::lock_guard lock(mutex_);
  action_ = std::move(action);
  if (seen_ && action_) action_();
}

void Interrupt::Wait() {
  const sigset_t signals = StopSignals();
  std::thread first;
  for (int signal = 0; sigwait(&signals, &signal) == 0 && !stopping_;) {
    if (seen_.exchange(true)) _exit(static_cast<int>(ExitCode::kInterrupted));
    // On its own thread, so that a second Ctrl-C is heard while the first is still at work.
    first = std::thread([this] {
      std::lock_guard lock(mutex_);
      if (action_) action_();
    });
  }
  if (first.joinable()) first.join();
}

}  // namespace lambert::app
