// Records in a PostgreSQL database: the store of coordinators that stand in for one another.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "server/base/clock.h"
#include "server/base/record_store.h"

namespace lambert::server {

struct PostgresOptions {
  std::string url;  // postgresql://USER@HOST/DATABASE, as libpq takes it
  // An owner that has not shown itself for so long has lost the store, by the database's clock, > 1
  // s.
  Duration takeover = std::chrono::seconds(5);
  // Called while another owns the store: waits a moment; false gives up.
  std::function<bool()> wait = [] { return false; };
};

// Connects, makes the tables where there are none, waits until no other coordinator owns the store
// and takes the next epoch. Whoever owned it before is FENCED from then on. CheckOwner shows that
// this one is alive: call it every second. A coordinator that ends in good order hands over at
// once.
//
// A connection that breaks is made again and the transaction repeated, for as long as `takeover`;
// then DATABASE_LOST. STORE_FAILED where the database cannot be used, CANCELLED where `wait` gave
// up.
absl::StatusOr<std::unique_ptr<RecordStore>> OpenPostgresRecordStore(
    const PostgresOptions& options);

}  // namespace lambert::server
