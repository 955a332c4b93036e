// The options --sky, --sun and --ies.
#pragma once

#include "CLI/CLI.hpp"
#include "app/option_groups.h"

namespace lambert::app {

void AddLightOptions(CLI::App& command, Draft& draft);

}  // namespace lambert::app
