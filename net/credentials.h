// How a program shows a server who it is, and sees that the server is the one it means.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"

namespace grpc {
class ChannelCredentials;
}

namespace lambert {

// Names of files, "" for none.
struct CredentialFiles {
  std::string tls_ca;             // PEM: who may have signed the server's certificate
  std::string tls_cert, tls_key;  // PEM: the program's own certificate with its chain, and its key
  std::string token;              // holds the token that `lambert-server --new-token` printed
};

// The options that name them, for every program that calls a server.
struct CredentialOption {
  const char* name;      // without dashes: "tls-ca"
  const char* variable;  // "LAMBERT_TLS_CA"
  const char* help;
  std::string CredentialFiles::*file;
};
const std::vector<CredentialOption>& CredentialOptions();

// For channels to `server` (HOST:PORT): TLS where a CA is given, else plain text. A token goes with
// every call; in plain text it never leaves this machine: the connection is refused where the other
// end is not a loopback address. FIELD_INVALID names the file that cannot be read or does not fit.
absl::StatusOr<std::shared_ptr<grpc::ChannelCredentials>> MakeChannelCredentials(
    const std::string& server, const CredentialFiles& files);

// The bytes of a file of credentials. FIELD_INVALID, naming `option`.
absl::StatusOr<std::string> ReadCredential(const std::string& option, const std::string& path);

// FIELD_INVALID where one of the files is no PEM of its kind, or the key is not the certificate's.
absl::Status CheckKeyPair(const std::string& cert_path, const std::string& key_path);

// True for HOST:PORT (or HOST) where only programs of this machine can be: 127.0.0.0/8, [::1],
// localhost.
bool IsLoopback(const std::string& address);

}  // namespace lambert
