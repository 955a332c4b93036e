#include "tests/support/temporary_postgres.h"

#include <pwd.h>
#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace lambert {
namespace {

// Debian keeps them out of PATH: /usr/lib/postgresql/VERSION/bin. "" where there are none.
std::string Programs() {
  std::error_code error;
  for (const auto& version : std::filesystem::directory_iterator("/usr/lib/postgresql", error)) {
    const std::string folder = version.path().string() + "/bin/";
    if (access((folder + "initdb").c_str(), X_OK) == 0) return folder;
  }
  return "";
}

// PostgreSQL refuses to run as root.
std::vector<std::string> AsUser(std::vector<std::string> command) {
  if (geteuid() == 0) {
    command.insert(command.begin(), {"/usr/bin/setpriv", "--reuid=postgres", "--regid=postgres",
                                     "--clear-groups", "--"});
  }
  return command;
}

}  // namespace

bool TemporaryPostgres::IsPossible(std::string& why) {
  if (Programs().empty()) {
    why = "PostgreSQL is not installed; apt-get install postgresql";
    return false;
  }
  if (geteuid() == 0 && getpwnam("postgres") == nullptr) {
    why = "there is no user postgres to run PostgreSQL as; apt-get install postgresql";
    return false;
  }
  return true;
}

TemporaryPostgres::TemporaryPostgres() {
  if (geteuid() == 0) {
    const passwd* user = getpwnam("postgres");
    if (chown(folder_.path().c_str(), user->pw_uid, user->pw_gid) != 0) std::abort();
  }
  Process made(AsUser({Programs() + "initdb", "-D", folder_.path() + "/data", "-U", "lambert", "-A",
                       "trust", "-E", "UTF8", "--no-locale", "--no-sync"}));
  if (made.Wait() != 0) {
    std::fprintf(stderr, "initdb: %s\n", made.error().c_str());
    std::abort();
  }
  Start();
}

TemporaryPostgres::~TemporaryPostgres() { Stop(); }

std::string TemporaryPostgres::url() const {
  return "postgresql://lambert@/postgres?host=" + folder_.path();
}

void TemporaryPostgres::Restart() {
  Stop();
  Start();
}

void TemporaryPostgres::Stop() {
  if (server_ == nullptr) return;
  server_->Signal(SIGINT);  // "fast": sessions are ended
  server_->Wait();
  server_.reset();
}

void TemporaryPostgres::Start() {
  server_ =
      std::make_unique<Process>(AsUser({Programs() + "postgres", "-D", folder_.path() + "/data",
                                        "-k", folder_.path(), "-c", "listen_addresses="}));
  if (server_->WaitForError("ready to accept connections") == std::string::npos) {
    std::fprintf(stderr, "postgres: %s\n", server_->error().c_str());
    std::abort();
  }
}

}  // namespace lambert
