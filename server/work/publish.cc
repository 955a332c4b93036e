// WorkTable: what jobs ask of it.
#include <algorithm>
#include <numeric>
#include <utility>

#include "server/work/refusals.h"
#include "server/work/work_table.h"

namespace lambert::server {
namespace {

// A gather's results hold each number once.
SumSize SizeOf(const PublishedStep& step) {
  if (!step.setup().gather_task_sha256.empty()) return {};
  return {step.setup().patch_count, std::max(static_cast<int>(step.shards().size()), 1)};
}

}  // namespace

absl::StatusOr<std::shared_ptr<PublishedStep>> WorkTable::Publish(
    const WorkSetup& setup, const std::vector<WorkUnit>& grains, bool may_shard) {
  std::vector<int64_t> rays;
  for (const WorkUnit& grain : grains) rays.push_back(grain.RayCount());
  // Of fewer rays than patches, all results are no larger than the sums would be.
  const int64_t all_rays = std::accumulate(rays.begin(), rays.end(), int64_t{0});
  const bool is_thick = all_rays >= setup.patch_count;
  const std::vector<ShardRange> shards =
      may_shard && is_thick ? shards_.Divide(setup.patch_count) : std::vector<ShardRange>();
  Calls calls;
  std::shared_ptr<PublishedStep> step;
  {
    absl::MutexLock lock(&mutex_);
    if (shutting_down_) return ShuttingDown();
    if (auto aborted = aborted_.find(setup.job); aborted != aborted_.end()) return aborted->second;
    step = std::make_shared<PublishedStep>(setup, next_step_++, grains, shards);
    steps_[setup.job] = step;
    AddStep(state_, setup.job, step->number(), rays, SizeOf(*step));
    Dispatch(calls);
  }
  shards_.Add(step);  // before any worker has a unit of it
  MakeCalls(calls);
  return step;
}

void WorkTable::Withdraw(const std::string& job) {
  Calls calls;
  std::shared_ptr<PublishedStep> step;
  {
    absl::MutexLock lock(&mutex_);
    RemoveStep(state_, job);
    if (auto found = steps_.find(job); found != steps_.end()) {
      step = std::move(found->second);
      steps_.erase(found);
    }
    Dispatch(calls);
  }
  if (step != nullptr) shards_.Remove(step);
  MakeCalls(calls);
}

void WorkTable::AbortJob(const std::string& job, const absl::Status& status) {
  absl::MutexLock lock(&mutex_);
  aborted_[job] = status;
  if (auto step = steps_.find(job); step != steps_.end()) step->second->Abort(status);
}

void WorkTable::ForgetJob(const std::string& job) {
  absl::MutexLock lock(&mutex_);
  aborted_.erase(job);
  state_.paces.erase(job);
}

}  // namespace lambert::server
