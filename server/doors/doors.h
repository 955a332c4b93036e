// Who may come in: tokens, certificates, or anybody.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "server/doors/followed_file.h"
#include "server/doors/identity.h"
#include "server/doors/revoked.h"
#include "server/doors/token_file.h"

namespace grpc {
class AuthContext;
class ServerContextBase;
class ServerCredentials;
}  // namespace grpc

namespace lambert::server {

// Names of files, "" for none.
struct DoorOptions {
  std::string tls_cert = {},
              tls_key = {};        // PEM: the server's certificate with its chain, and its key
  std::string tls_client_ca = {};  // PEM: who signs certificates of clients and workers
  std::string tls_revoked = {};    // which of those are taken back (revoked.h)
  std::string tokens = {};         // token_file.h
  bool insecure = false;           // true: listen anywhere, whoever may come
  std::function<void(const std::string&)> log = [](const std::string&) {};
};

// Whom a method is for. Admins are clients.
enum class Guests { kClients, kWorkers, kClientsAndWorkers, kMergers };

// Thread safe.
class Doors {
 public:
  // Without tokens and client CA doors are open: everybody may do everything. FIELD_INVALID names
  // the option that is wrong; INSECURE_ADDRESS where `listen` (HOST:PORT) is no loopback address
  // and doors are open, or tokens would come in plain text.
  static absl::StatusOr<std::unique_ptr<Doors>> Open(const DoorOptions& options,
                                                     const std::string& listen);

  // Who makes a call: whose token it brings or, where it brings none, whose certificate.
  // UNAUTHENTICATED (TOKEN_MISSING, TOKEN_UNKNOWN, CERTIFICATE_REVOKED), PERMISSION_DENIED
  // (ROLE_DENIED).
  absl::StatusOr<Identity> Admit(const grpc::ServerContextBase& context, Guests guests) const;

  // For the address that is listened on: TLS where there is a certificate.
  std::shared_ptr<grpc::ServerCredentials> credentials() const { return credentials_; }
  bool is_open() const { return tokens_ == nullptr && !takes_certificates_; }

 private:
  Doors() = default;
  absl::Status OpenTls(const DoorOptions& options);
  absl::StatusOr<Identity> Identify(const grpc::ServerContextBase& context) const;
  bool IsRevoked(const grpc::AuthContext& auth) const;

  std::unique_ptr<TokenFile> tokens_;  // null: none are taken
  bool takes_certificates_ = false;
  std::unique_ptr<FollowedFile<Revoked>> revoked_;  // null: none is taken back
  std::shared_ptr<grpc::ServerCredentials> credentials_;
};

// Who a certificate is of, by its SPIFFE id (the one URI among its subject alternative names):
// spiffe://lambert/ROLE/NAME. False for other ids.
bool ParseSpiffeId(const std::string& id, Identity* identity);

}  // namespace lambert::server
