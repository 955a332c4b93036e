#include "net/credentials.h"

#include <grpcpp/security/credentials.h>
#include <openssl/ssl.h>

#include <fstream>
#include <map>
#include <sstream>
#include <utility>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "radiosity/core/error.h"

namespace lambert {
namespace {

absl::Status Invalid(const std::string& option, const std::string& what, const std::string& hint) {
  return MakeError(absl::StatusCode::kInvalidArgument, {"FIELD_INVALID", option, what, hint});
}

// Puts the token into each call's metadata.
class BearerToken : public grpc::MetadataCredentialsPlugin {
 public:
  explicit BearerToken(const std::string& token) : header_("Bearer " + token) {}
  bool IsBlocking() const override { return false; }
  const char* GetType() const override { return "lambert-token"; }
  grpc::Status GetMetadata(grpc::string_ref, grpc::string_ref, const grpc::AuthContext&,
                           std::multimap<grpc::string, grpc::string>* metadata) override {
    metadata->insert({"authorization", header_});
    return grpc::Status::OK;
  }

 private:
  const std::string header_;
};

absl::StatusOr<std::string> ReadToken(const std::string& path) {
  absl::StatusOr<std::string> bytes = ReadCredential("token-file", path);
  if (!bytes.ok()) return bytes;
  const std::string token(absl::StripAsciiWhitespace(*bytes));
  for (const char c : token) {
    if (!absl::ascii_isgraph(static_cast<unsigned char>(c))) {
      return Invalid("token-file", path + " holds more than one word", "keep one token in it");
    }
  }
  if (token.empty()) return Invalid("token-file", path + " is empty", "keep one token in it");
  return token;
}

absl::StatusOr<std::shared_ptr<grpc::ChannelCredentials>> MakeTls(const CredentialFiles& files) {
  grpc::SslCredentialsOptions options;
  const std::pair<const char*, std::pair<const std::string*, grpc::string*>> wanted[] = {
      {"tls-ca", {&files.tls_ca, &options.pem_root_certs}},
      {"tls-cert", {&files.tls_cert, &options.pem_cert_chain}},
      {"tls-key", {&files.tls_key, &options.pem_private_key}}};
  for (const auto& [option, file] : wanted) {
    if (file.first->empty()) continue;
    absl::StatusOr<std::string> bytes = ReadCredential(option, *file.first);
    if (!bytes.ok()) return bytes.status();
    *file.second = *std::move(bytes);
  }
  if (!files.tls_cert.empty()) {
    if (absl::Status status = CheckKeyPair(files.tls_cert, files.tls_key); !status.ok()) {
      return status;
    }
  }
  return grpc::SslCredentials(options);
}

}  // namespace

const std::vector<CredentialOption>& CredentialOptions() {
  static const auto& options = *new std::vector<CredentialOption>{
      {"tls-ca", "LAMBERT_TLS_CA",
       "PEM file of who may have signed the server's certificate; switches TLS on",
       &CredentialFiles::tls_ca},
      {"tls-cert", "LAMBERT_TLS_CERT", "PEM file of this program's certificate",
       &CredentialFiles::tls_cert},
      {"tls-key", "LAMBERT_TLS_KEY", "PEM file of that certificate's key",
       &CredentialFiles::tls_key},
      {"token-file", "LAMBERT_TOKEN_FILE", "file with the token that the server gave out",
       &CredentialFiles::token}};
  return options;
}

absl::StatusOr<std::shared_ptr<grpc::ChannelCredentials>> MakeChannelCredentials(
    const std::string& server, const CredentialFiles& files) {
  if (files.tls_cert.empty() != files.tls_key.empty()) {
    return Invalid("tls-cert", "a certificate and its key go together",
                   "give both tls-cert and tls-key");
  }
  if (files.tls_ca.empty() && !files.tls_cert.empty()) {
    return Invalid("tls-cert", "a certificate is shown to servers that speak TLS only",
                   "give tls-ca too");
  }
  std::string token;
  if (!files.token.empty()) {
    absl::StatusOr<std::string> read = ReadToken(files.token);
    if (!read.ok()) return read.status();
    token = *std::move(read);
  }
  std::shared_ptr<grpc::ChannelCredentials> channel;
  if (!files.tls_ca.empty()) {
    absl::StatusOr<std::shared_ptr<grpc::ChannelCredentials>> tls = MakeTls(files);
    if (!tls.ok()) return tls;
    channel = *std::move(tls);
  } else if (token.empty()) {
    return grpc::InsecureChannelCredentials();
  } else if (!IsLoopback(server)) {
    return Invalid("token-file", "a token goes to " + server + " in plain text, for all to read",
                   "give tls-ca");
  } else {
    // Of a name such as localhost, gRPC holds the address that it stands for to be loopback.
    channel = grpc::experimental::LocalCredentials(LOCAL_TCP);
  }
  if (token.empty()) return channel;
  return grpc::CompositeChannelCredentials(
      channel, grpc::experimental::MetadataCredentialsFromPlugin(
                   std::make_unique<BearerToken>(token), GRPC_SECURITY_NONE));
}

absl::StatusOr<std::string> ReadCredential(const std::string& option, const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  if (!file.good()) return Invalid(option, path + " cannot be read", "name a file that is there");
  return std::move(bytes).str();
}

absl::Status CheckKeyPair(const std::string& cert_path, const std::string& key_path) {
  const std::unique_ptr<SSL_CTX, void (*)(SSL_CTX*)> context(SSL_CTX_new(TLS_method()),
                                                             SSL_CTX_free);
  if (SSL_CTX_use_certificate_chain_file(context.get(), cert_path.c_str()) != 1) {
    return Invalid("tls-cert", cert_path + " holds no certificate that can be used",
                   "name a PEM file of a certificate");
  }
  if (SSL_CTX_use_PrivateKey_file(context.get(), key_path.c_str(), SSL_FILETYPE_PEM) != 1) {
    return Invalid("tls-key", key_path + " is not the key of " + cert_path,
                   "name the PEM file that was made with the certificate");
  }
  return absl::OkStatus();
}

bool IsLoopback(const std::string& address) {
  const std::string host = address.substr(0, address.rfind(':'));
  if (host == "localhost" || host == "[::1]" || address == "::1") return true;
  if (!absl::StartsWith(host, "127.")) return false;
  int dots = 0;
  for (const char c : host) {
    if (c == '.') ++dots;
    if (c != '.' && !absl::ascii_isdigit(static_cast<unsigned char>(c))) return false;
  }
  return dots == 3;  // 127.example.org is a name
}

}  // namespace lambert
