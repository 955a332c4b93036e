#include "server/doors/token_file.h"

#include <fcntl.h>
#include <openssl/crypto.h>
#include <openssl/rand.h>
#include <unistd.h>

#include <cerrno>
#include <set>
#include <utility>

#include "absl/strings/escaping.h"
#include "absl/strings/str_split.h"
#include "radiosity/core/digest.h"
#include "radiosity/core/error.h"
#include "server/base/files.h"

namespace lambert::server {
namespace {

constexpr char kPrefix[] = "lambert_";  // what scanners for leaked secrets can look for
constexpr size_t kTokenBytes = 32;

absl::Status Invalid(const std::string& where, const std::string& what, const std::string& hint) {
  return MakeError(absl::StatusCode::kInvalidArgument, {"FIELD_INVALID", where, what, hint});
}

absl::Status CheckIdentity(const std::string& where, const std::string& name) {
  if (IsIdentityName(name)) return absl::OkStatus();
  return Invalid(where, "'" + name + "' is no name",
                 "use 1 to 40 of a-z, 0-9 and -, a letter first");
}

}  // namespace

absl::StatusOr<std::vector<TokenEntry>> ParseTokens(const std::string& text,
                                                    const std::string& path) {
  std::vector<TokenEntry> entries;
  std::set<std::string> seen;
  int number = 0;
  for (const absl::string_view line : absl::StrSplit(text, '\n')) {
    const std::string where = path + ", line " + std::to_string(++number);
    const absl::string_view said = line.substr(0, line.find('#'));
    const std::vector<std::string> words =
        absl::StrSplit(said, absl::ByAnyChar(" \t\r"), absl::SkipEmpty());
    if (words.empty()) continue;
    TokenEntry entry;
    if (words.size() != 3 || !ParseRole(words[1], &entry.identity.role) || !IsSha256Hex(words[2])) {
      return Invalid(where, "is not NAME ROLE SHA256, ROLE one of client, worker, admin",
                     "make lines with lambert-server --new-token");
    }
    if (absl::Status status = CheckIdentity(where, words[0]); !status.ok()) return status;
    if (!seen.insert(words[2]).second) {
      return Invalid(where, "repeats the token of another line", "make a token for each");
    }
    entry.identity.name = words[0];
    entry.sha256 = words[2];
    entries.push_back(std::move(entry));
  }
  return entries;
}

absl::StatusOr<std::string> AddToken(const std::string& path, const Identity& identity) {
  if (absl::Status status = CheckIdentity("new-token", identity.name); !status.ok()) return status;
  unsigned char bytes[kTokenBytes];
  if (RAND_bytes(bytes, sizeof(bytes)) != 1) {
    return absl::InternalError("the system has no random numbers");
  }
  const std::string token = kPrefix + absl::BytesToHexString(absl::string_view(
                                          reinterpret_cast<char*>(bytes), sizeof(bytes)));
  std::string line = identity.name + " " + RoleName(identity.role) + " " + Sha256Hex(token) + "\n";
  const int file = open(path.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0) return FileError(path, errno);
  const off_t end = lseek(file, 0, SEEK_END);
  char last = '\n';
  if (end > 0 && pread(file, &last, 1, end - 1) == 1 && last != '\n') line.insert(0, "\n");
  const bool written = write(file, line.data(), line.size()) == static_cast<ssize_t>(line.size()) &&
                       fsync(file) == 0;
  const int error = errno;
  close(file);
  if (!written) return FileError(path, error);
  return token;
}

absl::StatusOr<std::unique_ptr<TokenFile>> TokenFile::Open(
    const std::string& path, std::function<void(const std::string&)> log) {
  auto entries = Entries::Open("tokens", path, ParseTokens, std::move(log));
  if (!entries.ok()) return entries.status();
  return std::unique_ptr<TokenFile>(new TokenFile(*std::move(entries)));
}

std::shared_ptr<const Identity> TokenFile::Find(const std::string& token) {
  const std::shared_ptr<const std::vector<TokenEntry>> entries = entries_->Get();
  const std::string sha256 = Sha256Hex(token);
  const TokenEntry* found = nullptr;
  for (const TokenEntry& entry : *entries) {
    const bool equal = CRYPTO_memcmp(entry.sha256.data(), sha256.data(), sha256.size()) == 0;
    found = equal ? &entry : found;
  }
  if (found == nullptr) return nullptr;
  return {entries, &found->identity};
}

}  // namespace lambert::server
