// TLS between real sockets, with certificates of deploy/tls.
#include <cstdlib>
#include <fstream>

#include "lambert/v1/farm_service.grpc.pb.h"
#include "lambert/worker/v1/worker_service.grpc.pb.h"
#include "net/credentials.h"
#include "radiosity/core/error.h"
#include "tests/service/service_fixture.h"
#include "tests/support/temporary_folder.h"

namespace lambert {
namespace {

class Tls : public ServiceFixture {
 protected:
  Tls() {
    Make("server localhost 127.0.0.1");
    Make("client alice");
    Make("worker farm");
  }
  void Make(const std::string& arguments, const std::string& folder = "") {
    const std::string command =
        "deploy/tls/make_certificates.sh " + folder_.path() + folder + " " + arguments;
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
  }
  std::string File(const std::string& name) const { return folder_.path() + "/" + name; }

  void Serve(server::DoorOptions doors) {
    doors.tls_cert = File("server.crt");
    doors.tls_key = File("server.key");
    auto started = server::RpcServer::Start(coordinator_.get(), "127.0.0.1:0", doors);
    ASSERT_TRUE(started.ok()) << started.status();
    secure_ = *std::move(started);
  }
  std::shared_ptr<grpc::Channel> Dial(const CredentialFiles& files) {
    auto credentials = MakeChannelCredentials(secure_->address(), files);
    EXPECT_TRUE(credentials.ok()) << credentials.status();
    return grpc::CreateChannel(secure_->address(), *credentials);
  }
  CredentialFiles Certified(const std::string& name) const {
    return {File("ca.crt"), File(name + ".crt"), File(name + ".key"), ""};
  }
  grpc::Status ListWorkers(const CredentialFiles& files) {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(20));
    v1::ListWorkersResponse response;
    return v1::FarmService::NewStub(Dial(files))->ListWorkers(&context, {}, &response);
  }
  grpc::Status OpenSession(const CredentialFiles& files) {
    grpc::ClientContext context;
    worker::v1::CreateWorkerSessionRequest request;
    request.set_worker_id("w");
    request.set_slot_count(1);
    request.set_unit_version(UnitVersion());
    worker::v1::WorkerSession session;
    return worker::v1::WorkerService::NewStub(Dial(files))
        ->CreateWorkerSession(&context, request, &session);
  }

  TemporaryFolder folder_;
  std::unique_ptr<server::RpcServer> secure_;
};

TEST_F(Tls, RolesComeFromTheCertificate) {
  Serve({.tls_client_ca = File("ca.crt")});
  EXPECT_TRUE(ListWorkers(Certified("client-alice")).ok());
  EXPECT_EQ(ReasonOf(OpenSession(Certified("client-alice"))), "ROLE_DENIED");
  EXPECT_TRUE(OpenSession(Certified("worker-farm")).ok());
  EXPECT_EQ(ReasonOf(ListWorkers(Certified("worker-farm"))), "ROLE_DENIED");
  // A certificate of the right CA that names no role opens nothing.
  EXPECT_NE(ListWorkers(Certified("server")).error_code(), grpc::StatusCode::OK);
}

TEST_F(Tls, OtherCertificatesAndNoneAreRefused) {
  Serve({.tls_client_ca = File("ca.crt")});
  Make("client alice", "/other");
  EXPECT_EQ(ListWorkers({File("ca.crt"), "", "", ""}).error_code(), grpc::StatusCode::UNAVAILABLE);
  CredentialFiles forged = Certified("other/client-alice");
  EXPECT_EQ(ListWorkers(forged).error_code(), grpc::StatusCode::UNAVAILABLE);
  forged = Certified("client-alice");
  forged.tls_ca = File("other/ca.crt");  // it would not know this server
  EXPECT_EQ(ListWorkers(forged).error_code(), grpc::StatusCode::UNAVAILABLE);
  EXPECT_EQ(ListWorkers({}).error_code(), grpc::StatusCode::UNAVAILABLE);  // plain text
}

TEST_F(Tls, TokensAndCertificatesLiveSideBySide) {
  const std::string token = *server::AddToken(File("tokens"), {"bob", server::Role::kClient});
  std::ofstream(File("bob")) << token << "\n";
  Serve({.tls_client_ca = File("ca.crt"), .tokens = File("tokens")});
  EXPECT_TRUE(ListWorkers({File("ca.crt"), "", "", File("bob")}).ok());
  EXPECT_TRUE(ListWorkers(Certified("client-alice")).ok());
  EXPECT_EQ(ReasonOf(ListWorkers({File("ca.crt"), "", "", ""})), "TOKEN_MISSING");
}

TEST_F(Tls, ACertificateThatIsTakenBackOpensNothingFromTheNextCallOn) {
  Make("client bob");
  std::ofstream(File("revoked")) << "# nobody yet\n";
  Serve({.tls_client_ca = File("ca.crt"), .tls_revoked = File("revoked")});
  const auto farm = v1::FarmService::NewStub(Dial(Certified("client-alice")));
  const auto call = [&farm] {
    grpc::ClientContext context;
    v1::ListWorkersResponse response;
    return farm->ListWorkers(&context, {}, &response);
  };
  EXPECT_TRUE(call().ok());
  const std::string print = "openssl x509 -noout -fingerprint -sha256 -in " +
                            File("client-alice.crt") + " >>" + File("revoked");
  ASSERT_EQ(std::system(print.c_str()), 0);
  EXPECT_EQ(ReasonOf(call()), "CERTIFICATE_REVOKED");
  EXPECT_TRUE(ListWorkers(Certified("client-bob")).ok());
  // A list that cannot be read takes nobody back in.
  std::ofstream(File("revoked")) << "who knows\n";
  EXPECT_EQ(ReasonOf(call()), "CERTIFICATE_REVOKED");
  for (const server::DoorOptions& doors :
       {server::DoorOptions{.tls_revoked = File("revoked")},
        server::DoorOptions{.tls_client_ca = File("ca.crt"), .tls_revoked = File("revoked")}}) {
    server::DoorOptions with_key = doors;
    with_key.tls_cert = File("server.crt");
    with_key.tls_key = File("server.key");
    EXPECT_EQ(
        ReasonOf(server::RpcServer::Start(coordinator_.get(), "127.0.0.1:0", with_key).status()),
        "FIELD_INVALID");
  }
  EXPECT_EQ(ReasonOf(server::RpcServer::Start(coordinator_.get(), "127.0.0.1:0",
                                              {.tls_revoked = File("revoked")})
                         .status()),
            "FIELD_INVALID");
}

TEST_F(Tls, ATokenTravelsInPlainTextOnlyOnLoopback) {
  const std::string token = *server::AddToken(File("tokens"), {"bob", server::Role::kClient});
  std::ofstream(File("bob")) << token << "\n";
  secure_ =
      *server::RpcServer::Start(coordinator_.get(), "127.0.0.1:0", {.tokens = File("tokens")});
  EXPECT_TRUE(ListWorkers({"", "", "", File("bob")}).ok());
  EXPECT_EQ(ReasonOf(ListWorkers({})), "TOKEN_MISSING");
  for (const char* elsewhere : {"192.0.2.1:7400", "farm.example.org:7400"}) {
    const absl::Status refused =
        MakeChannelCredentials(elsewhere, {"", "", "", File("bob")}).status();
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(ReasonOf(refused), "FIELD_INVALID");
    EXPECT_NE(refused.message().find("plain text"), std::string::npos) << refused;
  }
}

TEST_F(Tls, FilesThatDoNotFitAreNamed) {
  std::ofstream(File("two")) << "two words";
  std::ofstream(File("empty"));
  const CredentialFiles bad[] = {
      {"", File("client-alice.crt"), File("client-alice.key"), ""},
      {File("ca.crt"), File("client-alice.crt"), "", ""},
      {File("ca.crt"), File("client-alice.crt"), File("worker-farm.key"), ""},
      {File("ca.crt"), File("ca.key"), File("ca.key"), ""},
      {"/no/such/file", "", "", ""},
      {"", "", "", File("two")},
      {"", "", "", File("empty")}};
  for (const CredentialFiles& files : bad) {
    const absl::Status status = MakeChannelCredentials("127.0.0.1:1", files).status();
    ASSERT_FALSE(status.ok()) << files.tls_cert << files.token;
    EXPECT_EQ(ReasonOf(status), "FIELD_INVALID");
  }
}

}  // namespace
}  // namespace lambert
