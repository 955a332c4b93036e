// Who calls.
#pragma once

#include <string>

namespace lambert::server {

enum class Role {
  kClient,   // has scenes and jobs of its own
  kWorker,   // computes units
  kMerger,   // a merge shard: takes the sums of patches
  kAdmin,    // a client who sees what all clients have
  kAnybody,  // whoever calls where doors are open: all of the above, under the name ""
};

// A name of 1 to 40 of a-z, 0-9 and -, a letter first; "" where doors are open. What is made
// belongs to the name: a token and a certificate of one name are one owner.
struct Identity {
  std::string name;
  Role role = Role::kAnybody;

  bool is_client() const { return role != Role::kWorker && role != Role::kMerger; }
  bool is_worker() const { return role == Role::kWorker || role == Role::kAnybody; }
  bool is_merger() const { return role == Role::kMerger || role == Role::kAnybody; }
  bool sees_all() const { return role == Role::kAdmin || role == Role::kAnybody; }
  // Whether it sees what belongs to `owner`.
  bool Sees(const std::string& owner) const { return sees_all() || owner == name; }
};

bool IsIdentityName(const std::string& name);

// "client", "worker", "merger", "admin"; false for other words.
bool ParseRole(const std::string& word, Role* role);
const char* RoleName(Role role);

}  // namespace lambert::server
