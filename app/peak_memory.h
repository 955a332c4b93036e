// How much memory this process has taken at most.
#pragma once

#include <cstdint>
#include <optional>

namespace lambert::app {

// Gives free memory back to the system and begins to watch anew.
void ResetPeakMemory();

// Largest resident size since ResetPeakMemory, or since the start where the system cannot begin
// anew. Empty where it does not tell.
std::optional<int64_t> PeakMemoryBytes();

}  // namespace lambert::app
