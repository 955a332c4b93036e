#include "tests/support/process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

namespace lambert {
namespace {

void Check(bool good, const char* what) {
  if (good) return;
  std::perror(what);
  std::abort();
}

[[noreturn]] void Exec(const std::vector<std::string>& command, const ProcessOptions& options) {
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  Check(options.folder.empty() || chdir(options.folder.c_str()) == 0, options.folder.c_str());
  for (const auto& [name, value] : options.environment) setenv(name.c_str(), value.c_str(), 1);
  std::vector<char*> arguments;
  for (const std::string& argument : command) {
    arguments.push_back(const_cast<char*>(argument.c_str()));
  }
  arguments.push_back(nullptr);
  execv(arguments[0], arguments.data());
  std::perror(arguments[0]);
  _exit(127);
}

}  // namespace

Process::Process(const std::vector<std::string>& command, const ProcessOptions& options) {
  int output[2], error[2];
  Check(pipe2(output, O_CLOEXEC) == 0 && pipe2(error, O_CLOEXEC) == 0, "pipe2");
  id_ = fork();
  Check(id_ >= 0, "fork");
  if (id_ == 0) {
    dup2(output[1], STDOUT_FILENO);
    dup2(error[1], STDERR_FILENO);
    Exec(command, options);
  }
  close(output[1]);
  close(error[1]);
  output_reader_ = std::thread([this, fd = output[0]] { Read(fd, output_, output_open_); });
  error_reader_ = std::thread([this, fd = error[0]] { Read(fd, error_, error_open_); });
}

Process::~Process() {
  if (exit_code_ < 0) {
    Signal(SIGKILL);
    Wait();
  }
}

void Process::Signal(int signal) const { kill(id_, signal); }

size_t Process::WaitForError(const std::string& text, size_t from) {
  std::unique_lock lock(mutex_);
  size_t found = std::string::npos;
  changed_.wait(lock, [&] {
    found = error_.find(text, from);
    return found != std::string::npos || !error_open_;
  });
  return found == std::string::npos ? found : found + text.size();
}

int Process::Wait() {
  if (exit_code_ >= 0) return exit_code_;
  output_reader_.join();
  error_reader_.join();
  int status = 0;
  Check(waitpid(id_, &status, 0) == id_, "waitpid");
  exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return exit_code_;
}

std::string Process::output() {
  std::lock_guard lock(mutex_);
  return output_;
}

std::string Process::error() {
  std::lock_guard lock(mutex_);
  return error_;
}

void Process::Read(int descriptor, std::string& text, bool& open) {
  char buffer[4096];
  ssize_t count = 0;
  while ((count = read(descriptor, buffer, sizeof(buffer))) > 0) {
    std::lock_guard lock(mutex_);
    text.append(buffer, count);
    changed_.notify_all();
  }
  close(descriptor);
  std::lock_guard lock(mutex_);
  open = false;
  changed_.notify_all();
}

}  // namespace lambert
