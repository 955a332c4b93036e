// Where a coordinator keeps what outlasts it: blobs as files, records in a database.
#pragma once

#include <functional>
#include <string>

#include "absl/status/statusor.h"
#include "server/coordinator.h"

namespace lambert::server {

struct StoreOptions {
  std::string data_folder = {};  // of blobs, in DIR/blobs; made where there is none
  // postgresql://...; "": records are in DIR/lambert.db, and a second server on the folder is
  // refused (STORE_IN_USE).
  std::string database = {};
  // With `database`: called while another server owns it; waits a moment, false gives up.
  std::function<bool()> wait = [] { return false; };
};

// Opens both, records first: with a database, once no other server owns it. FIELD_INVALID,
// CANCELLED where `wait` gave up, and the errors of the stores.
absl::StatusOr<Stores> OpenStores(const StoreOptions& options);

}  // namespace lambert::server
