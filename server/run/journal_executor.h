// Steps that are shot once: those of an interrupted run are answered from the journal.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "radiosity/solve/step_executor.h"
#include "server/base/clock.h"
#include "server/jobs/journal.h"

namespace lambert::server {

enum class JournalMode {
  kAuto,   // steps that took much longer than journalling them
  kEvery,  // each step, whatever that costs
  kOff,    // none: an interrupted job goes on from its last checkpoint
};

// What journalling a result is expected to take: learned from those before, in proportion to bytes.
class JournalCost {
 public:
  // 0 before the first: it is tried.
  double Expect(size_t result_bytes) const;
  void Learn(size_t result_bytes, double seconds);
  // Tells that it was not tried, so that one slow moment of the disk is forgotten in the end.
  void Forget();

 private:
  double seconds_per_byte_ = 0;
};

// Runs steps on `inner`, and keeps their results. One thread.
class JournalExecutor : public StepExecutor {
 public:
  // `log` is told at which step an interrupted job goes on. All pointers outlive the executor.
  JournalExecutor(StepExecutor* inner, Journal* journal, JournalMode mode, PatchIndex patch_count,
                  Clock clock, std::function<void(const std::string&)> log);

  // A result that cannot be kept for want of space is not: that is no error, it is shot again if
  // need be. FENCED, DATABASE_LOST, and what `inner` fails with.
  absl::StatusOr<UnitResult> RunStep(const std::vector<WorkUnit>& units) override;

  // What the journal took so far: "kept 12 of 40 steps in .31 s". "" where nothing outlasts the
  // process.
  std::string Summary() const;

 private:
  // Logs, once, where an interrupted job goes on.
  void TellResumed(const WorkUnit& unit);
  absl::Status Keep(const std::vector<WorkUnit>& units, const UnitResult& result,
                    double shot_seconds);

  StepExecutor* const inner_;
  Journal* const journal_;
  const JournalMode mode_;
  const PatchIndex patch_count_;
  const Clock clock_;
  const std::function<void(const std::string&)> log_;
  JournalCost cost_;
  int replayed_ = 0;         // steps answered from the journal
  int shot_ = 0, kept_ = 0;  // other steps; those of them that were added to it
  double keeping_seconds_ = 0;
  bool told_ = false;  // TellResumed has nothing to say any more
};

}  // namespace lambert::server
