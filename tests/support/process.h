// Programs as a user runs them, for tests.
#pragma once

#include <sys/types.h>

#include <condition_variable>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace lambert {

struct ProcessOptions {
  std::string folder;                              // working folder; "": the test's own
  std::map<std::string, std::string> environment;  // added to the test's own
};

// A running program and what it prints. A program that still runs when the object goes is killed.
class Process {
 public:
  // `command`: path and arguments. Aborts the test program where it cannot be started.
  explicit Process(const std::vector<std::string>& command, const ProcessOptions& options = {});
  ~Process();
  Process(const Process&) = delete;

  pid_t id() const { return id_; }
  void Signal(int signal) const;
  // Blocks until standard error holds `text` from `from` on, and returns where it ends there;
  // std::string::npos where the program closed it before.
  size_t WaitForError(const std::string& text, size_t from = 0);
  // Blocks until the program has ended: its exit code, or 128 + the signal that ended it.
  int Wait();
  // What was printed so far; all of it after Wait.
  std::string output();
  std::string error();

 private:
  void Read(int descriptor, std::string& text, bool& open);

  pid_t id_ = -1;
  int exit_code_ = -1;  // -1: not waited for yet
  std::mutex mutex_;    // guards all below
  std::condition_variable changed_;
  std::string output_, error_;
  bool output_open_ = true, error_open_ = true;
  std::thread output_reader_, error_reader_;
};

}  // namespace lambert
