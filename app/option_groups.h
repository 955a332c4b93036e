// The options of the subcommands, in groups as `--help` shows them. For the files that build the
// command line.
#pragma once

#include <string>
#include <vector>

#include "CLI/CLI.hpp"
#include "app/options.h"

namespace lambert::app {

// What the parser fills: the options, and what is settled only when all sources are known.
struct Draft {
  Options options;
  std::string quality;         // "" or preview, draft, final: a wanted error, and a mesh, by name
  int final_gather_rays = -1;  // < 0: what the quality says
  std::string adapt;           // "" or on, off
  int64_t adapt_patches = 0;   // 0: what the quality says
};

void AddSceneOptions(CLI::App& command, Draft& draft);     // SCENE, --max-edge, limits, ...
void AddAdaptOptions(CLI::App& command, Draft& draft);     // --adapt, --adapt-patches
void AddStopOptions(CLI::App& command, Draft& draft);      // --max-error, --quality, ...
void AddMethodOptions(CLI::App& command, Draft& draft);    // --method, --seed, --phs-...
void AddPlaceOptions(CLI::App& command, Draft& draft);     // --workers, --threads
void AddServerOptions(CLI::App& command, Draft& draft);    // --server, --reconnect, --tls-ca, ...
void AddMeasureOptions(CLI::App& command, Draft& draft);   // --reference, --region
void AddOutputOptions(CLI::App& command, Draft& draft);    // -o, --outputs, --final-gather, ...
void AddLightmapOptions(CLI::App& command, Draft& draft);  // --lightmap, --texels-per-meter, ...
void AddProgressOption(CLI::App& command, Draft& draft);   // --progress
void AddWatchOption(CLI::App& command, Draft& draft);      // --watch
void AddJsonOption(CLI::App& command, Draft& draft);       // --json

// SCENE... and what bake has and bench does not take away; --methods, --seeds, --budgets, ...
void AddBenchOptions(CLI::App& command, Draft& draft);

// The names of the settings that `method` does not look at.
std::vector<std::string> SettingsWithoutEffect(Method method);

// Names, without dashes, of options that decide nothing where a server does the work.
const std::vector<std::string>& OptionsOfThisProcess();

// Puts what a --quality stands for where nothing else was given: the rays of a final gather,
// whether and how far patches are adapted, and, where the name counts for it, the wanted error.
// `may_split`: no --max-edge 0 says that triangles stay as they are.
void SettleQuality(Draft& draft, bool counts_for_error, bool may_split);

}  // namespace lambert::app
