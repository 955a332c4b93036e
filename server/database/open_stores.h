// Where a coordinator keeps what outlasts it: blobs as files, records in a database.
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "server/coordinator.h"

namespace lambert::server {

// Opens the data folder, makes it where there is none, and owns it until the records go: a second
// server on one folder is refused (STORE_IN_USE). Blobs lie in DIR/blobs, records in
// DIR/lambert.db.
absl::StatusOr<Stores> OpenStores(const std::string& data_folder);

}  // namespace lambert::server
