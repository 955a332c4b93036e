#include "app/command_line.h"

#include <algorithm>
#include <utility>

#include "CLI/CLI.hpp"
#include "app/bench_list.h"
#include "app/exit.h"
#include "app/option_checks.h"
#include "app/option_groups.h"
#include "app/settings.h"
#include "fmt/format.h"
#include "radiosity/core/error.h"

namespace lambert::app {
namespace {

constexpr char kAbout[] =
    "Lambert computes how light spreads in a glTF scene: diffuse global illumination by Monte\n"
    "Carlo radiosity, in this process or on a farm. Light in lm/m2 and lx, lengths in metres.";

constexpr char kExamples[] =
    "Examples:\n"
    "  lambert bake room.glb -o out                      in this process, to an error of 3 %\n"
    "  lambert bake room.glb -o out --max-error 0.01     until 1 % is reached\n"
    "  lambert bake room.glb -o out --server host:7400   on a farm\n"
    "  lambert submit room.glb --server host:7400        leave it there; then watch and fetch\n"
    "  lambert compare out/patches.csv reference.csv     how far off is it?\n"
    "  lambert bench room.glb -o out --methods pmcr,phs  error against rays and time\n"
    "Every option can be set by a variable (LAMBERT_MAX_ERROR=0.01) and in ./lambert.toml\n"
    "(max-error = 0.01); a flag wins over a variable, a variable over the file.\n"
    "Exit: 0 done, 1 failed, 2 usage, 3 bad scene, 4 server not reached, 5 budget spent before\n"
    "the wanted error (result kept), 130 interrupted (result kept).";

struct Subcommand {
  Command command;
  CLI::App* parser;
};

class Parser {
 public:
  Parser() : app_(kAbout, "lambert") {
    app_.footer(kExamples);
    app_.set_version_flag("--version", std::string("lambert ") + LAMBERT_VERSION);
    app_.require_subcommand(0, 1);
    app_.get_formatter()->column_width(28);
    AddBaking();
    AddJobs();
    AddCompare();
    AddBench();
  }

  absl::StatusOr<ParsedLine> Parse(std::vector<std::string> arguments);
  // The names of all options that a file or a variable may set.
  std::vector<std::string> OptionNames() const;
  absl::Status Apply(const Settings& settings);
  // Settles what depends on several options; Requires: Parse succeeded with a command.
  absl::StatusOr<ParsedLine> Finish(const Settings& settings);

 private:
  CLI::App& Add(Command command, const std::string& name, const std::string& about) {
    CLI::App* parser = app_.add_subcommand(name, about);
    parser->allow_extras();  // told apart below, with a better answer than "not expected"
    subcommands_.push_back({command, parser});
    return *parser;
  }
  void AddBaking();
  void AddJobs();
  void AddCompare();
  void AddBench();
  // What bake, plan, submit and bench ask of a scene and of how it is solved.
  void AddSolving(CLI::App& command);
  absl::Status CheckCommandName(const std::vector<std::string>& arguments) const;
  absl::Status CheckExtras() const;
  Layer LayerOf(const std::string& option, const Settings& settings) const;
  void WarnOfEffectless(const std::vector<std::string>& options, const std::string& why,
                        std::vector<std::string>& warnings) const;
  std::vector<std::string> Warnings() const;
  absl::Status CheckComplete() const;

  CLI::App app_;
  Draft draft_;
  std::vector<Subcommand> subcommands_;
  const Subcommand* chosen_ = nullptr;
  std::vector<std::string> flags_;  // options that stood on the command line
};

std::string CommandName(const CLI::App& parser) { return "lambert " + parser.get_name(); }

void Parser::AddBaking() {
  CLI::App& bake = Add(Command::kBake, "bake", "solve a scene and write the result");
  CLI::App& plan = Add(Command::kPlan, "plan", "say what would be done and left out");
  CLI::App& submit = Add(Command::kSubmit, "submit", "start a job on a server, print its name");
  for (CLI::App* command : {&bake, &plan, &submit}) {
    if (command == &bake) AddOutputOptions(*command, draft_);
    AddSolving(*command);
  }
  AddLightmapOptions(bake, draft_);
}

void Parser::AddSolving(CLI::App& command) {
  AddSceneOptions(command, draft_);
  AddStopOptions(command, draft_);
  AddMethodOptions(command, draft_);
  AddPlaceOptions(command, draft_);
  AddServerOptions(command, draft_);
  AddMeasureOptions(command, draft_);
  AddProgressOption(command, draft_);
  AddJsonOption(command, draft_);
}

void Parser::AddBench() {
  CLI::App& bench = Add(Command::kBench, "bench", "error against rays and time, several methods");
  AddOutputOptions(bench, draft_);
  AddSolving(bench);
  AddBenchOptions(bench, draft_);
}

void Parser::AddJobs() {
  CLI::App& watch = Add(Command::kWatch, "watch", "follow a job until it ends");
  CLI::App& fetch = Add(Command::kFetch, "fetch", "write a job's latest result");
  CLI::App& cancel = Add(Command::kCancel, "cancel", "stop a job; its result so far stays");
  CLI::App& erase = Add(Command::kDelete, "delete", "remove an ended job and its result");
  for (CLI::App* command : {&watch, &fetch, &cancel, &erase}) {
    command->add_option("JOB", draft_.options.job, "a job's name, as submit prints it")->required();
  }
  CLI::App& jobs = Add(Command::kJobs, "jobs", "list the jobs of a server");
  CLI::App& workers = Add(Command::kWorkers, "workers", "list the workers of a server");
  AddOutputOptions(fetch, draft_);
  for (CLI::App* command : {&watch, &fetch, &cancel, &erase, &jobs, &workers}) {
    AddServerOptions(*command, draft_);
    if (command == &fetch) AddMeasureOptions(*command, draft_);
    if (command == &watch || command == &fetch) AddProgressOption(*command, draft_);
    if (command == &jobs || command == &workers) AddWatchOption(*command, draft_);
    AddJsonOption(*command, draft_);
  }
}

void Parser::AddCompare() {
  CLI::App& compare = Add(Command::kCompare, "compare", "error measures between two patches.csv");
  compare.add_option("A", draft_.options.compare_path, "the patches.csv that is judged")
      ->required();
  compare.add_option("B", draft_.options.compare_reference, "the patches.csv it is judged by")
      ->required();
  compare
      .add_option("--region", draft_.options.regions,
                  "glTF index of a node of the local error; may be repeated")
      ->option_text("NODE")
      ->allow_extra_args(false);
  AddJsonOption(compare, draft_);
}

absl::Status Parser::CheckCommandName(const std::vector<std::string>& arguments) const {
  std::vector<std::string> names;
  for (const Subcommand& subcommand : subcommands_) names.push_back(subcommand.parser->get_name());
  if (arguments.empty()) {
    return UsageError("lambert", fmt::format("no command given ({})", fmt::join(names, ", ")),
                      "try lambert bake SCENE -o DIR, or lambert --help");
  }
  const std::string& first = arguments.front();
  if (first.rfind("-", 0) == 0) return absl::OkStatus();
  if (std::find(names.begin(), names.end(), first) != names.end()) return absl::OkStatus();
  const std::string nearest = NearestWord(first, names);
  return UsageError("lambert",
                    fmt::format("'{}' is no command ({})", first, fmt::join(names, ", ")),
                    nearest.empty() ? "see lambert --help" : "did you mean lambert " + nearest);
}

absl::Status Parser::CheckExtras() const {
  const std::vector<std::string> extras = chosen_->parser->remaining();
  if (extras.empty()) return absl::OkStatus();
  const std::string command = CommandName(*chosen_->parser);
  const std::string& first = extras.front();
  if (first.rfind("-", 0) != 0) {
    return UsageError(command, fmt::format("'{}' is one argument too many", first),
                      "see " + command + " --help");
  }
  const std::string name = first.substr(0, first.find('='));
  std::vector<std::string> known;
  for (const CLI::Option* option : chosen_->parser->get_options()) {
    for (const std::string& long_name : option->get_lnames()) known.push_back("--" + long_name);
  }
  const std::string nearest = NearestWord(name, known);
  return UsageError(command, fmt::format("'{}' is no option", name),
                    nearest.empty() ? "see " + command + " --help" : "did you mean " + nearest);
}

absl::StatusOr<ParsedLine> Parser::Parse(std::vector<std::string> arguments) {
  if (absl::Status status = CheckCommandName(arguments); !status.ok()) return status;
  std::string command = "lambert";
  for (const Subcommand& subcommand : subcommands_) {
    if (subcommand.parser->get_name() == arguments.front()) command += " " + arguments.front();
  }
  std::reverse(arguments.begin(), arguments.end());  // the order that CLI11 takes a vector in
  try {
    app_.parse(std::move(arguments));
  } catch (const CLI::CallForHelp&) {
    return ParsedLine{std::nullopt, app_.help(), {}};
  } catch (const CLI::CallForVersion& version) {
    return ParsedLine{std::nullopt, std::string(version.what()) + "\n", {}};
  } catch (const CLI::ParseError& error) {
    // What was not understood is the better answer where both are wrong.
    return FromCliError(error, command);
  }
  for (const Subcommand& subcommand : subcommands_) {
    if (subcommand.parser->parsed()) chosen_ = &subcommand;
  }
  if (chosen_ == nullptr) return CheckCommandName({});
  if (absl::Status status = CheckExtras(); !status.ok()) return status;
  for (const CLI::Option* option : chosen_->parser->get_options()) {
    if (option->count() > 0 && !option->get_lnames().empty()) {
      flags_.push_back(option->get_lnames().front());
    }
  }
  return ParsedLine{};
}

std::vector<std::string> Parser::OptionNames() const {
  std::vector<std::string> names;
  for (const Subcommand& subcommand : subcommands_) {
    for (const CLI::Option* option : subcommand.parser->get_options()) {
      for (const std::string& name : option->get_lnames()) {
        if (name != "help") names.push_back(name);
      }
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

absl::Status Parser::Apply(const Settings& settings) {
  for (CLI::Option* option : chosen_->parser->get_options()) {
    if (option->get_lnames().empty() || option->count() > 0) continue;
    const auto setting = settings.find(option->get_lnames().front());
    if (setting == settings.end()) continue;
    try {
      option->add_result(setting->second.values);
      option->run_callback();
    } catch (const CLI::ParseError& error) {
      const auto detail = GetErrorDetail(FromCliError(error, CommandName(*chosen_->parser)));
      return UsageError(setting->second.where, detail->message, detail->hint);
    }
  }
  return absl::OkStatus();
}

Layer Parser::LayerOf(const std::string& option, const Settings& settings) const {
  if (std::find(flags_.begin(), flags_.end(), option) != flags_.end()) return Layer::kFlag;
  const auto setting = settings.find(option);
  return setting == settings.end() ? Layer::kDefault : setting->second.layer;
}

void Parser::WarnOfEffectless(const std::vector<std::string>& options, const std::string& why,
                              std::vector<std::string>& warnings) const {
  for (const std::string& option : options) {
    if (std::find(flags_.begin(), flags_.end(), option) != flags_.end()) {
      warnings.push_back(fmt::format("warning: --{} has no effect {}", option, why));
    }
  }
}

std::vector<std::string> Parser::Warnings() const {
  const Options& options = draft_.options;
  std::vector<std::string> warnings;
  const Method method = options.solve.shoot.method;
  WarnOfEffectless(SettingsWithoutEffect(method),
                   fmt::format("with --method {}", MethodName(method)), warnings);
  if (options.patch.adapt_patches == 0) {
    WarnOfEffectless({"adapt-patches"}, "where patches are not adapted (see --adapt)", warnings);
  }
  if (!options.server.empty()) {
    WarnOfEffectless(OptionsOfThisProcess(),
                     "with --server: work is done by the lambert-workers that serve it", warnings);
  } else {
    std::vector<std::string> of_servers = {"reconnect"};
    for (const CredentialOption& option : CredentialOptions()) of_servers.push_back(option.name);
    WarnOfEffectless(of_servers, "without --server", warnings);
  }
  if (chosen_->command == Command::kSubmit) {
    WarnOfEffectless({"reference", "region"}, "here: give it to lambert fetch", warnings);
  }
  if (!options.bench.budgets.empty()) {
    WarnOfEffectless({"max-rays", "max-time"}, "with --budgets", warnings);
  }
  if (!options.lightmap) {
    WarnOfEffectless({"texels-per-meter", "lightmap-page"}, "without --lightmap", warnings);
  }
  const bool measures = chosen_->command == Command::kBake || chosen_->command == Command::kFetch;
  if (options.reference_path.empty() && measures && method != Method::kImportance) {
    WarnOfEffectless({"region"}, "without --reference", warnings);
  }
  return warnings;
}

absl::Status Parser::CheckComplete() const {
  const Options& options = draft_.options;
  const std::string command = CommandName(*chosen_->parser);
  const bool benches = options.command == Command::kBench;
  const bool writes =
      benches || options.command == Command::kBake || options.command == Command::kFetch;
  if (writes && options.out_folder.empty()) {
    return UsageError(command, "no folder for the result", "add -o DIR");
  }
  const bool serverless = benches || options.command == Command::kBake ||
                          options.command == Command::kPlan || options.command == Command::kCompare;
  if (!serverless && options.server.empty()) {
    return UsageError(command, "no server given", "add --server HOST:PORT, or set LAMBERT_SERVER");
  }
  if (absl::Status status = options.patch.Validate(); !status.ok()) return status;
  if (benches) return ParseBenchEntries(options.bench.methods, options.solve).status();
  return options.solve.Validate();
}

absl::StatusOr<ParsedLine> Parser::Finish(const Settings& settings) {
  draft_.options.command = chosen_->command;
  // Told not to split, patches stay as they are.
  const bool may_split =
      draft_.options.patch.max_edge_m > 0 || LayerOf("max-edge", settings) == Layer::kDefault;
  // A number beats a name from the same source; any source beats those under it.
  SettleQuality(draft_, LayerOf("quality", settings) > LayerOf("max-error", settings), may_split);
  if (draft_.options.solve.shoot.method == Method::kImportance ||
      chosen_->command == Command::kBench) {
    draft_.options.solve.shoot.region = draft_.options.regions;
  }
  if (absl::Status status = CheckComplete(); !status.ok()) return status;
  return ParsedLine{draft_.options, "", Warnings()};
}

}  // namespace

absl::StatusOr<ParsedLine> ParseCommandLine(
    const std::vector<std::string>& arguments, const std::string& toml_text,
    const std::function<const char*(const std::string&)>& environment) {
  Parser parser;
  absl::StatusOr<ParsedLine> parsed = parser.Parse(arguments);
  if (!parsed.ok() || !parsed->text.empty()) return parsed;
  absl::StatusOr<Settings> settings = ReadSettings(parser.OptionNames(), toml_text, environment);
  if (!settings.ok()) return settings.status();
  if (absl::Status status = parser.Apply(*settings); !status.ok()) return status;
  return parser.Finish(*settings);
}

}  // namespace lambert::app
