// Who may come in, and whom each method is for.
#include "server/doors/doors.h"

#include <filesystem>
#include <fstream>

#include "lambert/v1/farm_service.grpc.pb.h"
#include "radiosity/core/error.h"
#include "tests/service/raw_call.h"
#include "tests/service/rpc_methods.h"
#include "tests/service/service_fixture.h"
#include "tests/support/temporary_folder.h"

namespace lambert::server {
namespace {

// The status of a call without a body.
grpc::Status CallEmpty(const std::shared_ptr<grpc::Channel>& channel, const std::string& method,
                       const std::string& authorization) {
  grpc::GenericStub stub(channel);
  return CallRaw(stub, method, "", authorization, std::chrono::seconds(30));
}

class DoorsTest : public ServiceFixture {
 protected:
  DoorsTest() : tokens_(folder_.path() + "/tokens") {
    client_ = *AddToken(tokens_, {"alice", Role::kClient});
    worker_ = *AddToken(tokens_, {"farm", Role::kWorker});
    merger_ = *AddToken(tokens_, {"shard", Role::kMerger});
    admin_ = *AddToken(tokens_, {"root", Role::kAdmin});
    rpc_ = *RpcServer::Start(coordinator_.get(), "", {.tokens = tokens_});
    Connect(rpc_->InProcessChannel());
  }
  std::string ReasonFor(const std::string& method, const std::string& authorization) {
    return lambert::ReasonOf(CallEmpty(channel(), method, authorization));
  }

  TemporaryFolder folder_;
  const std::string tokens_;
  std::string client_, worker_, merger_, admin_;
};

TEST_F(DoorsTest, EveryMethodAsksWhoCalls) {
  for (const auto* method : AllRpcMethods()) {
    const std::string path = PathOf(*method);
    const grpc::Status status = CallEmpty(channel(), path, "");
    EXPECT_EQ(status.error_code(), grpc::StatusCode::UNAUTHENTICATED) << path;
    EXPECT_EQ(lambert::ReasonOf(status), "TOKEN_MISSING") << path;
    for (const std::string& wrong : {std::string("Bearer nonsense"), "Basic " + client_, client_}) {
      EXPECT_EQ(ReasonFor(path, wrong), "TOKEN_UNKNOWN") << path;
    }
  }
}

TEST_F(DoorsTest, EachRoleCallsItsOwnMethodsAndNoOther) {
  for (const auto* method : AllRpcMethods()) {
    const std::string path = PathOf(*method);
    const bool is_of_mergers = method->service()->name() == "MergeService";
    const bool is_of_workers = method->file()->package() == "lambert.worker.v1" && !is_of_mergers;
    const bool is_of_both = path == "/lambert.v1.BlobService/DownloadBlob";
    const bool is_of_clients = !is_of_workers && !is_of_mergers;
    EXPECT_EQ(ReasonFor(path, "Bearer " + client_) == "ROLE_DENIED", !is_of_clients) << path;
    EXPECT_EQ(ReasonFor(path, "Bearer " + admin_) == "ROLE_DENIED", !is_of_clients) << path;
    EXPECT_EQ(ReasonFor(path, "Bearer " + merger_) == "ROLE_DENIED", !is_of_mergers) << path;
    EXPECT_EQ(ReasonFor(path, "Bearer " + worker_) == "ROLE_DENIED", !is_of_workers && !is_of_both)
        << path;
  }
  const auto info =
      ErrorInfoOf(CallEmpty(channel(), "/lambert.v1.SceneService/ListScenes", "Bearer " + worker_));
  EXPECT_EQ(info.metadata().at("role"), "worker");
  EXPECT_EQ(info.metadata().at("neededRole"), "client");
}

TEST_F(DoorsTest, WhoIsTakenOutOfTheFileStaysOutFromTheNextCallOn) {
  const std::string list = "/lambert.v1.SceneService/ListScenes";
  EXPECT_TRUE(CallEmpty(channel(), list, "Bearer " + client_).ok());
  std::ofstream(tokens_) << "# nobody\n";
  EXPECT_EQ(ReasonFor(list, "Bearer " + client_), "TOKEN_UNKNOWN");
  const std::string second = *AddToken(tokens_, {"alice", Role::kClient});
  EXPECT_TRUE(CallEmpty(channel(), list, "Bearer " + second).ok());
  // What cannot be read changes nothing: a slip of the hand locks nobody out.
  std::ofstream(tokens_) << "alice boss x\n";
  EXPECT_TRUE(CallEmpty(channel(), list, "Bearer " + second).ok());
}

TEST(TokenFile, HoldsNoToken) {
  TemporaryFolder folder;
  const std::string path = folder.path() + "/tokens";
  std::ofstream(path) << "# who may come";  // no line break at its end
  const std::string token = *AddToken(path, {"alice", Role::kClient});
  EXPECT_EQ(token.size(), 8u + 64u);
  std::ifstream file(path);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  EXPECT_EQ(text, "# who may come\nalice client " + Sha256Hex(token) + "\n");
  EXPECT_NE(*AddToken(path, {"alice", Role::kClient}), token);
  const auto made = folder.path() + "/made";
  ASSERT_TRUE(AddToken(made, {"alice", Role::kClient}).ok());
  EXPECT_EQ(std::filesystem::status(made).permissions(), std::filesystem::perms(0600));
}

TEST(TokenFile, NamesTheLineThatIsWrong) {
  const std::string digest(64, 'a');
  EXPECT_EQ(ParseTokens("\n# x\nalice client " + digest + " # hers\n", "f")->size(), 1u);
  for (const std::string& bad :
       {std::string("alice client"), "alice boss " + digest, "Alice client " + digest,
        "a client " + digest + "\nb client " + digest}) {
    const absl::Status status = ParseTokens("\n" + bad, "f").status();
    EXPECT_EQ(ReasonOf(status), "FIELD_INVALID") << bad;
    EXPECT_NE(status.message().find("f, line "), std::string::npos) << status;
  }
  EXPECT_EQ(ReasonOf(AddToken("/dev/null", {"../x", Role::kClient}).status()), "FIELD_INVALID");
}

TEST(Doors, OpenOnlyOnLoopback) {
  TemporaryFolder folder;
  const std::string tokens = folder.path() + "/tokens";
  ASSERT_TRUE(AddToken(tokens, {"alice", Role::kClient}).ok());
  for (const char* address : {"127.0.0.1:0", "localhost:1", "[::1]:0", "127.1.2.3:4"}) {
    EXPECT_TRUE(Doors::Open({}, address).ok()) << address;
  }
  for (const char* address : {"0.0.0.0:0", "[::]:0", "example.org:1", "127.0.0.example.org:1",
                              "10.0.0.1:7400", "*:7400", "unix:/tmp/x"}) {
    EXPECT_EQ(ReasonOf(Doors::Open({}, address).status()), "INSECURE_ADDRESS") << address;
    EXPECT_EQ(ReasonOf(Doors::Open({.tokens = tokens}, address).status()), "INSECURE_ADDRESS");
    EXPECT_TRUE(Doors::Open({.insecure = true}, address).ok()) << address;
  }
}

TEST(Doors, NameTheOptionThatIsWrong) {
  for (const DoorOptions& bad :
       {DoorOptions{.tls_cert = "c"}, DoorOptions{.tls_key = "k"},
        DoorOptions{.tls_client_ca = "ca"}, DoorOptions{.tls_cert = "no", .tls_key = "such"},
        DoorOptions{.tokens = "/no/such/file"}}) {
    EXPECT_EQ(ReasonOf(Doors::Open(bad, "127.0.0.1:0").status()), "FIELD_INVALID");
  }
}

TEST(SpiffeId, NamesRoleAndNameAndNothingElse) {
  Identity identity;
  ASSERT_TRUE(ParseSpiffeId("spiffe://lambert/worker/node-7", &identity));
  EXPECT_EQ(identity.name, "node-7");
  EXPECT_EQ(identity.role, Role::kWorker);
  for (const char* bad :
       {"", "spiffe://lambert/", "spiffe://lambert/worker", "spiffe://lambert/worker/",
        "spiffe://lambert/worker/a/b", "spiffe://lambert/anybody/a", "spiffe://lambert/Client/a",
        "spiffe://other/client/a", "spiffe://lambert/client/A", "lambert/client/a"}) {
    EXPECT_FALSE(ParseSpiffeId(bad, &identity)) << bad;
  }
}

}  // namespace
}  // namespace lambert::server
