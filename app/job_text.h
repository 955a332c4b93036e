// A job in words, for people and for programs.
#pragma once

#include <string>

#include "client/job.h"
#include "nlohmann/json.hpp"

namespace lambert::app {

nlohmann::ordered_json JobJson(const client::Job& job);

// One line without its end: name, state, error, rays, time, scene. JobHead names these columns.
std::string JobLine(const client::Job& job);
std::string JobHead();

// Indented, one line's end at the end; bytes that are no UTF-8 are replaced.
std::string JsonText(const nlohmann::ordered_json& json);

}  // namespace lambert::app
