// Named places at which a test can have the process die.
#pragma once

namespace lambert::server {

// Kills this process, as `kill -9` does, at the n-th passage of the place that the environment
// variable LAMBERT_FAILPOINT names: LAMBERT_FAILPOINT=blob-before-rename:3. Does nothing where it
// is unset or names another place. Thread safe.
void Failpoint(const char* name);

}  // namespace lambert::server
