#include "server/doors/doors.h"

#include <grpc/grpc_security_constants.h>
#include <grpcpp/security/auth_context.h>
#include <grpcpp/security/server_credentials.h>
#include <grpcpp/server_context.h>

#include <utility>
#include <vector>

#include "absl/strings/match.h"
#include "absl/strings/str_split.h"
#include "net/credentials.h"
#include "radiosity/core/error.h"
#include "server/base/status_proto.h"

namespace lambert::server {
namespace {

constexpr char kTrustDomain[] = "spiffe://lambert/";
constexpr char kBearer[] = "Bearer ";

absl::Status Invalid(const std::string& option, const std::string& what, const std::string& hint) {
  return MakeError(absl::StatusCode::kInvalidArgument, {"FIELD_INVALID", option, what, hint});
}

absl::Status Unauthenticated(const std::string& reason, const std::string& what,
                             const std::string& hint) {
  return MakeError(absl::StatusCode::kUnauthenticated, {reason, "the caller", what, hint});
}

absl::Status NoCertificatesToRevoke() {
  return Invalid("tls-revoked", "no certificates are taken that could be taken back",
                 "give --tls-client-ca too");
}

absl::Status CheckAddress(const DoorOptions& options, const std::string& listen) {
  if (options.insecure || listen.empty() || IsLoopback(listen)) return absl::OkStatus();
  const char* what = nullptr;
  if (options.tls_cert.empty() && !options.tokens.empty()) {
    what = "tokens would come in plain text, for all to read";
  } else if (options.tokens.empty() && options.tls_client_ca.empty()) {
    what = "anybody who reaches this address could use the server";
  }
  if (what == nullptr) return absl::OkStatus();
  return MakeError(
      absl::StatusCode::kFailedPrecondition,
      {"INSECURE_ADDRESS", listen, what,
       "give --tls-cert and --tls-key with --tokens or --tls-client-ca (docs/security.md), listen "
       "on 127.0.0.1, or say --insecure"});
}

bool IsFor(Guests guests, const Identity& identity) {
  switch (guests) {
    case Guests::kClients:
      return identity.is_client();
    case Guests::kWorkers:
      return identity.is_worker();
    case Guests::kClientsAndWorkers:
      return identity.is_client() || identity.is_worker();
    case Guests::kMergers:
      return identity.is_merger();
  }
  return false;
}

const char* NeededRole(Guests guests) {
  switch (guests) {
    case Guests::kClients:
      return "client";
    case Guests::kWorkers:
      return "worker";
    case Guests::kClientsAndWorkers:
      return "client or worker";
    case Guests::kMergers:
      return "merger";
  }
  return "";
}

}  // namespace

bool ParseSpiffeId(const std::string& id, Identity* identity) {
  if (!absl::StartsWith(id, kTrustDomain)) return false;
  const std::vector<std::string> parts = absl::StrSplit(id.substr(sizeof(kTrustDomain) - 1), '/');
  if (parts.size() != 2 || !ParseRole(parts[0], &identity->role) || !IsIdentityName(parts[1])) {
    return false;
  }
  identity->name = parts[1];
  return true;
}

absl::StatusOr<std::unique_ptr<Doors>> Doors::Open(const DoorOptions& options,
                                                   const std::string& listen) {
  if (absl::Status status = CheckAddress(options, listen); !status.ok()) return status;
  std::unique_ptr<Doors> doors(new Doors);
  if (absl::Status status = doors->OpenTls(options); !status.ok()) return status;
  if (!options.tokens.empty()) {
    absl::StatusOr<std::unique_ptr<TokenFile>> tokens =
        TokenFile::Open(options.tokens, options.log);
    if (!tokens.ok()) return tokens.status();
    doors->tokens_ = *std::move(tokens);
  }
  return doors;
}

absl::Status Doors::OpenTls(const DoorOptions& options) {
  if (options.tls_cert.empty() != options.tls_key.empty()) {
    return Invalid("tls-cert", "a certificate and its key go together",
                   "give both --tls-cert and --tls-key");
  }
  if (options.tls_cert.empty()) {
    if (!options.tls_client_ca.empty()) {
      return Invalid("tls-client-ca", "certificates are only shown where the server has one",
                     "give --tls-cert and --tls-key too");
    }
    if (!options.tls_revoked.empty()) return NoCertificatesToRevoke();
    credentials_ = grpc::InsecureServerCredentials();
    return absl::OkStatus();
  }
  if (absl::Status status = CheckKeyPair(options.tls_cert, options.tls_key); !status.ok()) {
    return status;
  }
  absl::StatusOr<std::string> cert = ReadCredential("tls-cert", options.tls_cert);
  absl::StatusOr<std::string> key = ReadCredential("tls-key", options.tls_key);
  if (!cert.ok()) return cert.status();
  if (!key.ok()) return key.status();
  grpc::SslServerCredentialsOptions ssl(
      options.tls_client_ca.empty() ? GRPC_SSL_DONT_REQUEST_CLIENT_CERTIFICATE
      // Who has a token may come without a certificate.
      : options.tokens.empty() ? GRPC_SSL_REQUEST_AND_REQUIRE_CLIENT_CERTIFICATE_AND_VERIFY
                               : GRPC_SSL_REQUEST_CLIENT_CERTIFICATE_AND_VERIFY);
  ssl.pem_key_cert_pairs.push_back({*std::move(key), *std::move(cert)});
  if (!options.tls_client_ca.empty()) {
    absl::StatusOr<std::string> ca = ReadCredential("tls-client-ca", options.tls_client_ca);
    if (!ca.ok()) return ca.status();
    ssl.pem_root_certs = *std::move(ca);
    takes_certificates_ = true;
  } else if (!options.tls_revoked.empty()) {
    return NoCertificatesToRevoke();
  }
  if (!options.tls_revoked.empty()) {
    auto revoked =
        FollowedFile<Revoked>::Open("tls-revoked", options.tls_revoked, ParseRevoked, options.log);
    if (!revoked.ok()) return revoked.status();
    revoked_ = *std::move(revoked);
  }
  credentials_ = grpc::SslServerCredentials(ssl);
  return absl::OkStatus();
}

bool Doors::IsRevoked(const grpc::AuthContext& auth) const {
  if (revoked_ == nullptr) return false;
  const std::vector<grpc::string_ref> pem =
      auth.FindPropertyValues(GRPC_X509_PEM_CERT_PROPERTY_NAME);
  return pem.size() != 1 || revoked_->Get()->count(Fingerprint({pem[0].data(), pem[0].size()})) > 0;
}

absl::StatusOr<Identity> Doors::Identify(const grpc::ServerContextBase& context) const {
  if (is_open()) return Identity();
  const auto header = context.client_metadata().find("authorization");
  if (tokens_ != nullptr && header != context.client_metadata().end()) {
    const absl::string_view text(header->second.data(), header->second.size());
    const bool is_bearer = absl::StartsWith(text, kBearer);
    const std::shared_ptr<const Identity> found =
        is_bearer ? tokens_->Find(std::string(text.substr(sizeof(kBearer) - 1))) : nullptr;
    if (found != nullptr) return *found;
    return Unauthenticated("TOKEN_UNKNOWN", "the server does not know this token",
                           "ask who runs the server for a new one");
  }
  if (takes_certificates_) {
    const auto auth = context.auth_context();
    const std::vector<grpc::string_ref> ids =
        auth == nullptr || !auth->IsPeerAuthenticated()
            ? std::vector<grpc::string_ref>()
            : auth->FindPropertyValues(GRPC_PEER_SPIFFE_ID_PROPERTY_NAME);
    Identity identity;
    if (ids.size() == 1 && ParseSpiffeId({ids[0].data(), ids[0].size()}, &identity)) {
      if (!IsRevoked(*auth)) return identity;
      return Unauthenticated("CERTIFICATE_REVOKED", "this certificate was taken back",
                             "ask who runs the server for a new one");
    }
  }
  return Unauthenticated("TOKEN_MISSING", "the call says not who makes it",
                         takes_certificates_ ? "give a certificate whose URI is "
                                               "spiffe://lambert/ROLE/NAME, or a token"
                                             : "give --token-file");
}

absl::StatusOr<Identity> Doors::Admit(const grpc::ServerContextBase& context, Guests guests) const {
  absl::StatusOr<Identity> identity = Identify(context);
  if (!identity.ok() || IsFor(guests, *identity)) return identity;
  absl::Status denied =
      MakeError(absl::StatusCode::kPermissionDenied,
                {"ROLE_DENIED", identity->name,
                 std::string("a ") + RoleName(identity->role) + " may not call this method",
                 std::string("come with the token or certificate of a ") + NeededRole(guests)});
  AddMetadata(denied, "role", RoleName(identity->role));
  AddMetadata(denied, "neededRole", NeededRole(guests));
  return denied;
}

}  // namespace lambert::server
