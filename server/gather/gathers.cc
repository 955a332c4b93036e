#include "server/gather/gathers.h"

#include <utility>
#include <vector>

#include "radiosity/core/digest.h"
#include "radiosity/core/error.h"
#include "radiosity/gather/gather_units.h"
#include "radiosity/solve/solution.h"
#include "server/base/status_proto.h"

namespace lambert::server {
namespace {

constexpr int kThreads = 2;
constexpr int kMostRunning = 100;  // and waiting
constexpr size_t kMostEnded = 1000;
// Points are told apart by 32 bits.
constexpr int64_t kMostNames = (int64_t{1} << 32) - static_cast<int64_t>(kMaxGatherPoints);
constexpr char kPart[] = "/gathers/";

absl::Status FieldInvalid(const std::string& field, const std::string& what,
                          const std::string& hint) {
  return MakeError(absl::StatusCode::kInvalidArgument, {"FIELD_INVALID", field, what, hint});
}

absl::Status Validate(const v1::CreateGatherRequest& request) {
  if (request.rays_per_point() < 1 || request.rays_per_point() > kMaxGatherRays) {
    return FieldInvalid("rays_per_point", std::to_string(request.rays_per_point()) + " rays",
                        "ask for 1 to " + std::to_string(kMaxGatherRays));
  }
  if (request.first_point() < 0 || request.first_point() > kMostNames) {
    return FieldInvalid("first_point", "is out of range", "ask for fewer points");
  }
  if (!IsSha256Hex(request.points_digest().sha256())) {
    return FieldInvalid("points_digest", "is not a SHA-256", "upload the points first");
  }
  return absl::OkStatus();
}

v1::Digest DigestOf(const std::string& bytes) {
  v1::Digest digest;
  digest.set_sha256(Sha256Hex(bytes));
  digest.set_size_bytes(static_cast<int64_t>(bytes.size()));
  return digest;
}

}  // namespace

struct Gathers::Entry {
  std::string name, owner;
  size_t points = 0;
  int rays_per_point = 0;
  v1::Digest patch_set, task;
  std::string task_bytes;  // until they are stored
  // Guarded by the mutex of the gathers:
  v1::Gather::State state = v1::Gather::STATE_RUNNING;
  std::shared_ptr<PublishedStep> step;  // null: waits
  absl::StatusOr<v1::Digest> result = absl::UnknownError("not there yet");
};

Gathers::Gathers(const RunnerParts& parts) : parts_(parts), pool_(kThreads) {}

Gathers::~Gathers() = default;

absl::StatusOr<v1::Gather> Gathers::Create(const Identity& who,
                                           const v1::CreateGatherRequest& request) {
  if (absl::Status valid = Validate(request); !valid.ok()) return valid;
  absl::StatusOr<std::shared_ptr<Entry>> entry = Prepare(who, request);
  if (entry.ok()) entry = Start(*std::move(entry));
  if (!entry.ok()) return entry.status();
  return Describe(**entry);
}

absl::StatusOr<v1::Gather> Gathers::Get(const Identity& who, const std::string& name) const {
  const size_t job_size = name.find(kPart);
  absl::StatusOr<std::shared_ptr<Job>> job = parts_.jobs->Find(name.substr(0, job_size), who);
  if (!job.ok()) return job.status();
  std::shared_ptr<Entry> entry;
  {
    absl::MutexLock lock(&mutex_);
    if (auto found = entries_.find(name); found != entries_.end()) entry = found->second;
  }
  if (entry != nullptr) return Describe(*entry);
  return MakeError(absl::StatusCode::kNotFound,
                   {"GATHER_NOT_FOUND", name, "there is no such gather", "create it again"});
}

absl::StatusOr<std::shared_ptr<Gathers::Entry>> Gathers::Prepare(
    const Identity& who, const v1::CreateGatherRequest& request) const {
  absl::StatusOr<std::shared_ptr<Job>> job = parts_.jobs->Find(request.parent(), who);
  if (!job.ok()) return job.status();
  const v1::SolveJob record = (*job)->Get();
  if (!record.has_latest_snapshot()) {
    return MakeError(absl::StatusCode::kNotFound,
                     {"SNAPSHOT_NOT_FOUND", record.name(), "the job has no solution yet",
                      "wait for its first snapshot"});
  }
  if (absl::Status left = parts_.quotas->CheckWork((*job)->owner()); !left.ok()) return left;
  auto points_blob = parts_.holdings->Read(who, request.points_digest().sha256());
  if (!points_blob.ok()) return points_blob.status();
  absl::StatusOr<GatherPoints> points = DecodeGatherPoints(std::string((*points_blob)->bytes()));
  if (!points.ok()) {
    return MakeError(absl::StatusCode::kInvalidArgument,
                     {"GATHER_INVALID", "points_digest", "the bytes are no points",
                      "send at most " + std::to_string(kMaxGatherPoints) +
                          " points in the bytes of docs/formats.md"});
  }
  auto solution_blob = parts_.blobs->Get(record.latest_snapshot().payload_digest().sha256());
  if (!solution_blob.ok()) return solution_blob.status();
  absl::StatusOr<Solution> solution = DecodeSolution(std::string((*solution_blob)->bytes()));
  if (!solution.ok()) return solution.status();
  GatherTask task;
  task.options = {request.rays_per_point(), static_cast<uint64_t>(request.seed())};
  task.first_name = static_cast<uint32_t>(request.first_point());
  task.radiosity_lm_per_m2 = std::move(solution->radiosity_lm_per_m2);
  task.points = *std::move(points);
  auto entry = std::make_shared<Entry>();
  entry->owner = (*job)->owner();
  entry->points = task.points.size();
  entry->rays_per_point = task.options.rays_per_point;
  entry->patch_set = record.patch_set_digest();
  entry->task_bytes = EncodeGatherTask(task);
  entry->task = DigestOf(entry->task_bytes);
  entry->name = record.name() + kPart + entry->task.sha256();
  return entry;
}

std::shared_ptr<Gathers::Entry> Gathers::FindUsable(const std::string& name) const {
  std::shared_ptr<Entry> entry;
  v1::Digest result;
  {
    absl::MutexLock lock(&mutex_);
    auto found = entries_.find(name);
    if (found == entries_.end() || found->second->state == v1::Gather::STATE_FAILED) return nullptr;
    entry = found->second;
    if (entry->state == v1::Gather::STATE_RUNNING) return entry;
    result = *entry->result;
  }
  return parts_.blobs->Has(result.sha256()) ? entry : nullptr;
}

absl::StatusOr<std::shared_ptr<Gathers::Entry>> Gathers::Start(std::shared_ptr<Entry> entry) {
  if (std::shared_ptr<Entry> known = FindUsable(entry->name); known != nullptr) return known;
  {
    absl::MutexLock lock(&mutex_);
    std::shared_ptr<Entry>& known = entries_[entry->name];
    if (known != nullptr && known->state == v1::Gather::STATE_RUNNING) return known;
    if (running_ >= kMostRunning) {
      return MakeError(absl::StatusCode::kResourceExhausted,
                       {"TOO_MANY_GATHERS", entry->name,
                        std::to_string(running_) + " gathers run or wait", "try again later"});
    }
    ++running_;
    known = entry;
  }
  parts_.refs->Add(entry->patch_set.sha256());
  pool_.Run([this, entry] { Run(*entry); });
  return entry;
}

void Gathers::Run(Entry& entry) {
  parts_.refs->Add(entry.task.sha256());
  absl::StatusOr<v1::Digest> result = Solve(entry);
  parts_.refs->Release(entry.task.sha256());
  parts_.refs->Release(entry.patch_set.sha256());
  absl::MutexLock lock(&mutex_);
  --running_;
  entry.state = result.ok() ? v1::Gather::STATE_SUCCEEDED : v1::Gather::STATE_FAILED;
  entry.result = std::move(result);
  entry.step = nullptr;
  ended_.push_back(entry.name);
  if (ended_.size() <= kMostEnded) return;
  auto oldest = entries_.find(ended_.front());
  if (oldest != entries_.end() && oldest->second->state != v1::Gather::STATE_RUNNING) {
    entries_.erase(oldest);
  }
  ended_.pop_front();
}

absl::StatusOr<UnitResult> Gathers::RunUnits(Entry& entry) {
  const std::string id = entry.name.substr(entry.name.find('/') + 1);
  WorkSetup setup;
  setup.job = id;
  setup.patch_set_sha256 = entry.patch_set.sha256();
  setup.patch_set_bytes = entry.patch_set.size_bytes();
  setup.patch_count = static_cast<PatchIndex>(2 * entry.points);
  setup.gather_task_sha256 = entry.task.sha256();
  setup.gather_task_bytes = entry.task.size_bytes();
  auto step = parts_.work->Publish(setup, CutGather(entry.points, entry.rays_per_point),
                                   /*may_shard=*/false);
  if (!step.ok()) return step.status();
  {
    absl::MutexLock lock(&mutex_);
    entry.step = *step;
  }
  absl::StatusOr<UnitResult> result = (*step)->Wait();
  parts_.work->Withdraw(id);
  parts_.work->ForgetJob(id);
  return result;
}

absl::StatusOr<v1::Digest> Gathers::Solve(Entry& entry) {
  absl::Status status = parts_.blobs->Put(entry.task.sha256(), std::move(entry.task_bytes));
  if (!status.ok()) return status;
  absl::StatusOr<UnitResult> result = UnitResult{};
  if (entry.points > 0) result = RunUnits(entry);
  if (!result.ok()) return result.status();
  const int64_t rays = 2 * static_cast<int64_t>(entry.points) * entry.rays_per_point;
  parts_.quotas->Charge(entry.owner, rays, result->cpu_seconds);
  absl::StatusOr<Gathered> gathered = GatheredOf(*result, entry.points);
  if (!gathered.ok()) return gathered.status();
  std::string bytes = EncodeGathered(*gathered);
  const v1::Digest digest = DigestOf(bytes);
  status = parts_.holdings->CheckBytes(entry.owner, digest.size_bytes());
  if (status.ok()) status = parts_.blobs->Put(digest.sha256(), std::move(bytes));
  if (!status.ok()) return status;
  parts_.refs->NoteUpload(digest.sha256(), entry.owner, digest.size_bytes());
  return digest;
}

v1::Gather Gathers::Describe(const Entry& entry) const {
  absl::MutexLock lock(&mutex_);
  v1::Gather gather;
  gather.set_name(entry.name);
  gather.set_state(entry.state);
  if (entry.step != nullptr) gather.set_done_fraction(entry.step->done_fraction());
  if (entry.state == v1::Gather::STATE_SUCCEEDED) {
    gather.set_done_fraction(1);
    *gather.mutable_result_digest() = *entry.result;
  }
  if (entry.state == v1::Gather::STATE_FAILED) {
    *gather.mutable_error() = ToStatusProto(entry.result.status());
  }
  return gather;
}

}  // namespace lambert::server
