#include "server/doors/revoked.h"

#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509.h>

#include <algorithm>
#include <memory>

#include "absl/strings/ascii.h"
#include "absl/strings/escaping.h"
#include "absl/strings/str_split.h"
#include "radiosity/core/digest.h"
#include "radiosity/core/error.h"

namespace lambert::server {

absl::StatusOr<Revoked> ParseRevoked(const std::string& text, const std::string& path) {
  Revoked revoked;
  int number = 0;
  for (const absl::string_view line : absl::StrSplit(text, '\n')) {
    ++number;
    const absl::string_view said = line.substr(0, line.find('#'));
    // "sha256 Fingerprint=AB:CD:..."
    const size_t equals = said.find('=');
    std::string digits = absl::AsciiStrToLower(absl::StripAsciiWhitespace(
        equals == absl::string_view::npos ? said : said.substr(equals + 1)));
    digits.erase(std::remove(digits.begin(), digits.end(), ':'), digits.end());
    if (digits.empty() && equals == absl::string_view::npos) continue;
    if (!IsSha256Hex(digits)) {
      return MakeError(absl::StatusCode::kInvalidArgument,
                       {"FIELD_INVALID", path + ", line " + std::to_string(number),
                        "is no SHA-256 fingerprint of a certificate",
                        "make lines with openssl x509 -noout -fingerprint -sha256 -in FILE"});
    }
    revoked.insert(digits);
  }
  return revoked;
}

std::string Fingerprint(const std::string& pem) {
  const std::unique_ptr<BIO, decltype(&BIO_free)> bytes(
      BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())), BIO_free);
  const std::unique_ptr<X509, decltype(&X509_free)> certificate(
      PEM_read_bio_X509(bytes.get(), nullptr, nullptr, nullptr), X509_free);
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned size = 0;
  if (certificate == nullptr || X509_digest(certificate.get(), EVP_sha256(), digest, &size) != 1) {
    return "";
  }
  return absl::BytesToHexString(absl::string_view(reinterpret_cast<char*>(digest), size));
}

}  // namespace lambert::server
