// A PostgreSQL server of a test's own, in a temporary folder, reached by a socket in it alone.
#pragma once

#include <memory>
#include <string>

#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace lambert {

class TemporaryPostgres {
 public:
  // False, with a reason in `why`, where PostgreSQL (Debian's package postgresql) is not installed,
  // or where root finds no user postgres to run it as.
  static bool IsPossible(std::string& why);

  // Requires: IsPossible. Aborts the test program where the server does not start.
  TemporaryPostgres();
  ~TemporaryPostgres();

  // postgresql://...
  std::string url() const;
  // Ends the server, and every connection with it, and starts it again.
  void Restart();
  // Ends it for good.
  void Stop();

 private:
  void Start();

  TemporaryFolder folder_;
  std::unique_ptr<Process> server_;
};

}  // namespace lambert
