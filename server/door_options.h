// The options of lambert-server, and of lambert-merger, that say who may come in, and what they may
// use.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "absl/status/status.h"
#include "server/coordinator.h"
#include "server/doors/doors.h"

namespace lambert::server {

// What --new-token asks for, beside the file of --tokens.
struct NewToken {
  std::string name;  // "": no new token is asked for
  std::string role = "client";
};

// Of every program that is called. Returns --tokens.
CLI::Option* AddDoorOptions(CLI::App& app, DoorOptions& doors);
void AddNewTokenOptions(CLI::App& app, CLI::Option* tokens, NewToken& wanted);

// What a client may have, and what a scene or job may take.
void AddLimitOptions(CLI::App& app, CoordinatorOptions& options);

// Adds a token to the file and prints it on standard output. Fails as AddToken does.
absl::Status PrintNewToken(const std::string& file, const NewToken& wanted);

}  // namespace lambert::server
