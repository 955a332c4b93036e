// What the rays of each patch have hit so far, by cell of its hemisphere: the alpha statistics of
// the method phs-alpha (JPS00, 3.3).
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "radiosity/shoot/unit.h"

namespace lambert {

// A set of (emitter, cell, patch), with how often each was seen, up to kManyTimes. Adding is free
// of order. One thread at a time.
class SightingTable {
 public:
  SightingTable();
  ~SightingTable();
  SightingTable& operator=(SightingTable&&);

  void Add(const std::vector<Sighting>& sightings);

  // Patches that rays of an emitter have hit through each of `cells` cells: alpha_ip n_ip. Empty
  // where nothing is known of it. With `unseen`, and those that were not hit yet, as estimated from
  // the patches that were hit once and twice (Cha84, in its form without bias):
  //   S + f1 (f1 - 1) / (2 (f2 + 1))
  std::vector<uint32_t> Counts(int32_t emitter, int cells, bool unseen) const;

  // All of it, in order.
  std::string Encode() const;
  // DATA_LOSS, and nothing is known after, on other bytes.
  absl::Status Restore(const std::string& bytes);

 private:
  struct OfEmitter;
  std::map<int32_t, OfEmitter> emitters_;
};

}  // namespace lambert
