#include "server/doors/identity.h"

#include <algorithm>

namespace lambert::server {
namespace {

constexpr size_t kMaxNameLength = 40;
constexpr Role kNamedRoles[] = {Role::kClient, Role::kWorker, Role::kMerger, Role::kAdmin};

}  // namespace

bool IsIdentityName(const std::string& name) {
  auto is_letter = [](char c) { return c >= 'a' && c <= 'z'; };
  return !name.empty() && name.size() <= kMaxNameLength && is_letter(name.front()) &&
         std::all_of(name.begin(), name.end(),
                     [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '-'; });
}

const char* RoleName(Role role) {
  switch (role) {
    case Role::kClient:
      return "client";
    case Role::kWorker:
      return "worker";
    case Role::kMerger:
      return "merger";
    case Role::kAdmin:
      return "admin";
    case Role::kAnybody:
      return "anybody";
  }
  return "";
}

bool ParseRole(const std::string& word, Role* role) {
  for (const Role named : kNamedRoles) {
    if (word != RoleName(named)) continue;
    *role = named;
    return true;
  }
  return false;
}

}  // namespace lambert::server
