// What a server knows, as a table: jobs, workers.
#include <unistd.h>

#include <string>

#include "app/commands.h"
#include "app/connection.h"
#include "app/job_text.h"
#include "app/live.h"
#include "app/progress_text.h"
#include "fmt/format.h"

namespace lambert::app {
namespace {

using Json = nlohmann::ordered_json;

// People see what the columns are; programs read lines of one kind.
std::string Head(const std::string& line) { return isatty(STDOUT_FILENO) ? line + "\n" : ""; }

std::string JobsTable(const std::vector<client::Job>& jobs) {
  std::string table = Head(JobHead());
  for (const client::Job& job : jobs) table += JobLine(job) + "\n";
  return table;
}

std::string JobsJson(const std::vector<client::Job>& jobs) {
  Json list = Json::array();
  for (const client::Job& job : jobs) list.push_back(JobJson(job));
  return JsonText(list);
}

std::string WorkersTable(const std::vector<client::Worker>& workers) {
  std::string table = Head(fmt::format("{:<40} {:>9} {:>16} {:>14}  {}", "WORKER", "SLOTS",
                                       "UNITS HELD", "DONE", "HEARD OF"));
  for (const client::Worker& worker : workers) {
    table += fmt::format("{:<40} {:>3} slots {:>5} units held {:>9} done  heard of {} ago\n",
                         worker.name, worker.slots, worker.leases, worker.finished_units,
                         FormatDuration(worker.silence_s));
  }
  return table;
}

std::string WorkersJson(const std::vector<client::Worker>& workers) {
  Json list = Json::array();
  for (const client::Worker& worker : workers) {
    list.push_back({{"worker", worker.name},
                    {"slots", worker.slots},
                    {"leases", worker.leases},
                    {"finished_units", worker.finished_units},
                    {"silence_s", worker.silence_s}});
  }
  return JsonText(list);
}

}  // namespace

absl::StatusOr<ExitCode> RunJobs(const Options& options, Interrupt& interrupt) {
  auto connection = Connection::Open(options, interrupt);
  if (!connection.ok()) return connection.status();
  return ShowTable(options.watch_list, interrupt, [&]() -> absl::StatusOr<std::string> {
    auto jobs = (*connection)->client().ListJobs();
    if (!jobs.ok()) return jobs.status();
    return options.json ? JobsJson(*jobs) : JobsTable(*jobs);
  });
}

absl::StatusOr<ExitCode> RunWorkers(const Options& options, Interrupt& interrupt) {
  auto connection = Connection::Open(options, interrupt);
  if (!connection.ok()) return connection.status();
  return ShowTable(options.watch_list, interrupt, [&]() -> absl::StatusOr<std::string> {
    auto workers = (*connection)->client().ListWorkers();
    if (!workers.ok()) return workers.status();
    return options.json ? WorkersJson(*workers) : WorkersTable(*workers);
  });
}

}  // namespace lambert::app
