// Ctrl-C: once, stop and keep the best so far; twice, leave at once.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <thread>

namespace lambert::app {

// Takes SIGINT and SIGTERM off every thread that is started afterwards and waits for them on a
// thread of its own, so that what happens at the first signal is ordinary code: it may lock and
// call. The second signal ends the process with exit code 130. One object a process, made before
// any other thread.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();

  bool seen() const { return seen_; }

  // Sets what the first signal does from now on, on the signal thread; at once where the signal
  // has come already. An empty function takes it away and waits for a running one to end.
  void OnFirst(std::function<void()> action);

 private:
  void Wait();

  std::atomic<bool> seen_ = false;
  std::atomic<bool> stopping_ = false;
  std::mutex mutex_;  // guards action_, held while it runs
  std::function<void()> action_;
  std::thread thread_;
};

}  // namespace lambert::app
