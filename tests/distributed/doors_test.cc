// Programs behind closed doors.
#include <gtest/gtest.h>

#include <fstream>

#include "tests/distributed/farm.h"

namespace lambert {
namespace {

// Makes a token of the name, as a user does, and keeps it in the folder's file of that name.
std::string MakeToken(const TemporaryFolder& folder, const std::string& name,
                      const std::string& role) {
  Process made(
      {LAMBERT_SERVER, "--tokens", folder.path() + "/tokens", "--new-token", name, "--role", role});
  EXPECT_EQ(made.Wait(), 0) << made.error();
  std::ofstream(folder.path() + "/" + name) << made.output();
  return folder.path() + "/" + name;
}

TEST(ClosedDoors, AServerThatAnybodyCouldReachDoesNotStart) {
  Process open({LAMBERT_SERVER, "--listen", "0.0.0.0:0"});
  EXPECT_EQ(open.Wait(), 1);
  EXPECT_NE(open.error().find("error: 0.0.0.0:0: anybody who reaches"), std::string::npos)
      << open.error();
  EXPECT_NE(open.error().find("--insecure"), std::string::npos);
  EXPECT_EQ(Process({LAMBERT_SERVER, "--new-token", "alice"}).Wait(), 2);
  EXPECT_EQ(Process({LAMBERT_SERVER, "--tokens", "t", "--role", "worker"}).Wait(), 2);
}

TEST(ClosedDoors, AWorkerWithoutTheRightTokenLeaves) {
  TemporaryFolder folder;
  const std::string client = MakeToken(folder, "alice", "client");
  const std::string worker = MakeToken(folder, "farm", "worker");
  Farm farm({"--tokens", folder.path() + "/tokens"});
  Process none({LAMBERT_WORKER, "--server", farm.address()});
  EXPECT_EQ(none.Wait(), 1);
  EXPECT_NE(none.error().find("give --token-file"), std::string::npos) << none.error();
  Process wrong({LAMBERT_WORKER, "--server", farm.address(), "--token-file", client});
  EXPECT_EQ(wrong.Wait(), 1);
  EXPECT_NE(wrong.error().find("a client may not call this"), std::string::npos) << wrong.error();
  // The environment will do too.
  Process right({LAMBERT_WORKER, "--server", farm.address()},
                {"", {{"LAMBERT_TOKEN_FILE", worker}}});
  EXPECT_NE(right.WaitForError("at work"), std::string::npos) << right.error();
}

}  // namespace
}  // namespace lambert
