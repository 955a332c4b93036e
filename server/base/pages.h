// Lists a page at a time: the rule is the same for every List method.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "absl/status/statusor.h"

namespace lambert::server {

inline constexpr int kDefaultPageSize = 50;
inline constexpr int kMaxPageSize = 500;

// 0 becomes the default, what is too large the maximum. FIELD_INVALID for a negative size.
absl::StatusOr<int> CheckPageSize(int page_size);

template <typename T>
struct Page {
  std::vector<T> items;
  std::string next_page_token;  // empty after the last page
};

// The items that `is_shown`, whose keys come after `page_token`. A page token is the last key of
// the page before: what comes and goes between pages neither repeats nor hides other items.
template <typename T, typename IsShown>
absl::StatusOr<Page<T>> TakePage(const std::map<std::string, T>& items, int page_size,
                                 const std::string& page_token, const IsShown& is_shown) {
  absl::StatusOr<int> size = CheckPageSize(page_size);
  if (!size.ok()) return size.status();
  Page<T> page;
  auto item = page_token.empty() ? items.begin() : items.upper_bound(page_token);
  for (; item != items.end(); ++item) {
    if (!is_shown(item->second)) continue;
    if (static_cast<int>(page.items.size()) == *size) return page;
    page.items.push_back(item->second);
    page.next_page_token = item->first;
  }
  page.next_page_token.clear();
  return page;
}

template <typename T>
absl::StatusOr<Page<T>> TakePage(const std::map<std::string, T>& items, int page_size,
                                 const std::string& page_token) {
  return TakePage(items, page_size, page_token, [](const T&) { return true; });
}

}  // namespace lambert::server
