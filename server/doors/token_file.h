// The tokens that open the doors: who has one, and its SHA-256. Never the token itself.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "server/doors/followed_file.h"
#include "server/doors/identity.h"

namespace lambert::server {

// One line a token: `NAME ROLE SHA256`, ROLE client, worker, merger or admin. Empty lines and what
// follows a # are left out. A name may have several tokens, so that one can take the place of
// another.
struct TokenEntry {
  Identity identity;
  std::string sha256;
};

// FIELD_INVALID names the line.
absl::StatusOr<std::vector<TokenEntry>> ParseTokens(const std::string& text,
                                                    const std::string& path);

// Makes a token of 256 random bits, adds its line to the file (made where there is none, readable
// by its owner only) and returns it: nobody can tell it later.
absl::StatusOr<std::string> AddToken(const std::string& path, const Identity& identity);

// A token file that is followed: who is added or removed in it comes in or stays out from the next
// call on. Thread safe.
class TokenFile {
 public:
  // Fails as ReadCredential and ParseTokens do.
  static absl::StatusOr<std::unique_ptr<TokenFile>> Open(
      const std::string& path, std::function<void(const std::string&)> log);

  // Whose token it is; null for nobody's. Takes as long whatever the token is.
  std::shared_ptr<const Identity> Find(const std::string& token);

 private:
  using Entries = FollowedFile<std::vector<TokenEntry>>;
  explicit TokenFile(std::unique_ptr<Entries> entries) : entries_(std::move(entries)) {}

  const std::unique_ptr<Entries> entries_;
};

}  // namespace lambert::server
