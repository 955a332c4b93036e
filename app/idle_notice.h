// Tells the user when a job stands still because nobody works for it.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "app/progress.h"
#include "client/client.h"

namespace lambert::app {

// One thread. Its parts outlive it.
class IdleNotice {
 public:
  IdleNotice(client::Client* client, ProgressPrinter* printer, std::string server)
      : client_(client), printer_(printer), server_(std::move(server)) {}

  // To be called with every progress. Once no ray was added for a while, asks for the workers, and
  // where there are none says so: once for each standstill.
  void Check(const Progress& progress);

 private:
  client::Client* const client_;
  ProgressPrinter* const printer_;
  const std::string server_;
  int64_t rays_ = -1;
  double moved_at_s_ = 0;
  bool told_ = false;
};

}  // namespace lambert::app
