#include "server/base/pages.h"

#include <algorithm>

#include "radiosity/core/error.h"

namespace lambert::server {

absl::StatusOr<int> CheckPageSize(int page_size) {
  if (page_size < 0) {
    return MakeError(absl::StatusCode::kInvalidArgument,
                     {"FIELD_INVALID", "page_size", "is negative", "use 0 for the default"});
  }
  return page_size == 0 ? kDefaultPageSize : std::min(page_size, kMaxPageSize);
}

}  // namespace lambert::server
