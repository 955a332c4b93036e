// The metrics of a merge shard, as /metrics shows them; docs/metrics.md lists them.
#pragma once

#include <string>

#include "server/merge/merge_shard.h"

namespace lambert::server {

std::string MergerText(MergeShard& shard);

}  // namespace lambert::server
