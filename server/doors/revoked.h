// Certificates that are taken back before they end.
#pragma once

#include <set>
#include <string>

#include "absl/status/statusor.h"

namespace lambert::server {

// SHA-256 fingerprints, 64 lower-case hexadecimal characters each.
using Revoked = std::set<std::string>;

// One line a certificate, as `openssl x509 -noout -fingerprint -sha256 -in FILE` prints it, or its
// hex digits alone. Empty lines and what follows a # are left out. FIELD_INVALID names the line.
absl::StatusOr<Revoked> ParseRevoked(const std::string& text, const std::string& path);

// Of a certificate in PEM; "" where it is none.
std::string Fingerprint(const std::string& pem);

}  // namespace lambert::server
