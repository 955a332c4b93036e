#include "server/jobs/job_store.h"

#include <algorithm>
#include <random>
#include <utility>

#include "google/protobuf/util/message_differencer.h"
#include "lambert/v1/snapshot_service.pb.h"
#include "radiosity/core/digest.h"
#include "radiosity/core/error.h"
#include "server/base/timestamp.h"
#include "server/jobs/journal.h"
#include "server/jobs/spec.h"

namespace lambert::server {
namespace {

constexpr char kJobs[] = "jobs";
constexpr char kSnapshots[] = "snapshots";
constexpr char kPrefix[] = "solveJobs/";
constexpr size_t kMaxIdLength = 63;
constexpr size_t kMaxRequestIdLength = 128;

bool IsId(const std::string& id) {
  auto is_letter = [](char c) { return c >= 'a' && c <= 'z'; };
  auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (id.empty() || id.size() > kMaxIdLength || !is_letter(id.front()) || id.back() == '-') {
    return false;
  }
  return std::all_of(id.begin(), id.end(),
                     [&](char c) { return is_letter(c) || is_digit(c) || c == '-'; });
}

// The id that a request asks for. One with a request id only always gets the same.
absl::StatusOr<std::string> ChooseId(const v1::CreateSolveJobRequest& request) {
  if (!request.solve_job_id().empty()) {
    if (IsId(request.solve_job_id())) return request.solve_job_id();
    return MakeError(absl::StatusCode::kInvalidArgument,
                     {"FIELD_INVALID", "solve_job_id", "'" + request.solve_job_id() + "' is no id",
                      "use up to 63 of a-z, 0-9 and -, a letter first and no - last"});
  }
  if (request.request_id().size() > kMaxRequestIdLength) {
    return MakeError(
        absl::StatusCode::kInvalidArgument,
        {"FIELD_INVALID", "request_id", "is longer than 128 characters", "use a random UUID"});
  }
  std::random_device random;
  std::string seed = request.request_id();
  if (seed.empty()) seed = std::to_string(random()) + "-" + std::to_string(random());
  return "job-" + Sha256Hex(seed).substr(0, 12);
}

absl::Status JobNotFound(const std::string& name) {
  return MakeError(absl::StatusCode::kNotFound,
                   {"JOB_NOT_FOUND", name, "there is no such job", "list the jobs there are"});
}

}  // namespace

JobStore::JobStore(BlobRefs* refs, RecordStore* records, const Quotas* quotas, int max_waiting)
    : refs_(refs), records_(records), quotas_(quotas), max_waiting_(max_waiting) {}

absl::StatusOr<std::vector<std::shared_ptr<Job>>> JobStore::Restore() {
  absl::StatusOr<std::map<std::string, std::string>> records = records_->LoadAll(kJobs);
  if (!records.ok()) return records.status();
  absl::StatusOr<std::map<std::string, std::string>> histories = records_->LoadAll(kSnapshots);
  if (!histories.ok()) return histories.status();
  absl::StatusOr<std::map<std::string, std::string>> points = records_->LoadAll(kResumePoints);
  if (!points.ok()) return points.status();
  std::vector<std::shared_ptr<Job>> unfinished;
  absl::MutexLock lock(&mutex_);
  for (const auto& [id, bytes] : *records) {
    v1::SolveJob record;
    if (!record.ParseFromString(bytes)) return DamagedRecord(kJobs, id);
    v1::ListSnapshotsResponse history;
    if (!history.ParseFromString((*histories)[id])) return DamagedRecord(kSnapshots, id);
    store::v1::ResumePoint point;
    if (!point.ParseFromString((*points)[id])) return DamagedRecord(kResumePoints, id);
    for (const std::string& blob : BlobsOf(point)) refs_->Add(blob);
    if (record.has_patch_set_digest()) refs_->Add(record.patch_set_digest().sha256());
    if (record.has_latest_snapshot()) {
      refs_->Add(record.latest_snapshot().payload_digest().sha256());
    }
    const bool ended = IsFinal(record.state());
    if (!ended) record.set_state(v1::SolveJob::STATE_QUEUED);
    std::vector<v1::Snapshot> snapshots(history.snapshots().begin(), history.snapshots().end());
    auto job = std::make_shared<Job>(std::move(record), std::move(snapshots));
    if (!ended) unfinished.push_back(job);
    jobs_[job->name()] = job;
  }
  return unfinished;
}

absl::StatusOr<JobStore::Created> JobStore::Create(const v1::CreateSolveJobRequest& request,
                                                   const v1::Scene& scene,
                                                   const std::string& unit_version) {
  absl::StatusOr<std::string> id = ChooseId(request);
  if (!id.ok()) return id.status();
  v1::SolveJob record;
  // An id has no dot: what a client chooses is never the name of another's job.
  record.set_name(kPrefix + (scene.owner().empty() ? *id : scene.owner() + "." + *id));
  record.set_owner(scene.owner());
  record.set_scene(scene.name());
  record.set_scene_display_name(scene.display_name());
  *record.mutable_spec() = request.spec();
  record.set_state(v1::SolveJob::STATE_QUEUED);
  *record.mutable_progress() = EncodeProgress(Progress());
  record.set_unit_version(unit_version);
  *record.mutable_create_time() = TimestampNow();
  auto job = std::make_shared<Job>(record);
  {
    absl::MutexLock lock(&mutex_);
    if (auto known = jobs_.find(record.name()); known != jobs_.end()) {
      const v1::SolveJob other = known->second->Get();
      const bool is_equal =
          other.scene() == record.scene() &&
          google::protobuf::util::MessageDifferencer::Equals(other.spec(), record.spec());
      if (is_equal) return Created{known->second, false};
      return MakeError(absl::StatusCode::kAlreadyExists,
                       {"JOB_ID_TAKEN", record.name(), "a job of this name solves something else",
                        "choose another id"});
    }
    const auto waiting = std::count_if(jobs_.begin(), jobs_.end(),
                                       [](const auto& entry) { return !entry.second->ended(); });
    if (waiting >= max_waiting_) {
      return MakeError(
          absl::StatusCode::kResourceExhausted,
          {"TOO_MANY_JOBS", record.name(), std::to_string(waiting) + " jobs have not ended yet",
           "wait for some, or cancel them"});
    }
    const auto own = std::count_if(jobs_.begin(), jobs_.end(), [&](const auto& entry) {
      return entry.second->owner() == scene.owner() && !entry.second->ended();
    });
    if (absl::Status status = quotas_->CheckJobs(scene.owner(), own); !status.ok()) return status;
    jobs_[record.name()] = job;
  }
  absl::Status saved = Save(*job);
  if (saved.ok()) return Created{job, true};
  absl::MutexLock lock(&mutex_);
  jobs_.erase(record.name());
  return saved;
}

absl::StatusOr<std::shared_ptr<Job>> JobStore::Find(const std::string& name,
                                                    const Identity& who) const {
  absl::MutexLock lock(&mutex_);
  auto job = jobs_.find(name);
  if (job == jobs_.end() || !who.Sees(job->second->owner())) return JobNotFound(name);
  return job->second;
}

absl::StatusOr<Page<std::shared_ptr<Job>>> JobStore::List(int page_size,
                                                          const std::string& page_token,
                                                          const Identity& who) const {
  absl::MutexLock lock(&mutex_);
  return TakePage(jobs_, page_size, page_token,
                  [&](const std::shared_ptr<Job>& job) { return who.Sees(job->owner()); });
}

std::vector<std::shared_ptr<Job>> JobStore::All() const {
  absl::MutexLock lock(&mutex_);
  std::vector<std::shared_ptr<Job>> all;
  for (const auto& [name, job] : jobs_) all.push_back(job);
  return all;
}

absl::Status JobStore::Delete(const std::string& name, const Identity& who) {
  std::shared_ptr<Job> job;
  {
    absl::MutexLock lock(&mutex_);
    auto found = jobs_.find(name);
    if (found == jobs_.end() || !who.Sees(found->second->owner())) return JobNotFound(name);
    if (!found->second->ended()) {
      return MakeError(absl::StatusCode::kFailedPrecondition,
                       {"JOB_NOT_ENDED", name, "the job has not ended", "cancel it first"});
    }
    job = found->second;
  }
  std::vector<RecordChange> changes;
  // A resume point is there where a full disk kept the job's end from being written.
  for (const char* kind : {kJobs, kSnapshots, kResumePoints}) {
    changes.push_back({kind, job->id(), std::nullopt});
  }
  absl::Status gone = records_->Commit(changes);
  if (!gone.ok()) return gone;
  {
    absl::MutexLock lock(&mutex_);
    if (jobs_.erase(name) == 0) return JobNotFound(name);  // somebody else was faster
  }
  const v1::SolveJob record = job->Get();
  if (record.has_patch_set_digest()) refs_->Release(record.patch_set_digest().sha256());
  if (record.has_latest_snapshot()) {
    refs_->Release(record.latest_snapshot().payload_digest().sha256());
  }
  return absl::OkStatus();
}

bool JobStore::UsesScene(const std::string& scene, const std::string& owner) const {
  for (const std::shared_ptr<Job>& job : All()) {
    if (!job->ended() && job->owner() == owner && job->Get().scene() == scene) return true;
  }
  return false;
}

bool JobStore::IsPatchSetOfRunning(const std::string& sha256) const {
  for (const std::shared_ptr<Job>& job : All()) {
    if (!job->ended() && job->Get().patch_set_digest().sha256() == sha256) return true;
  }
  return false;
}

void JobStore::AddBlobsOf(const std::string& owner, std::map<std::string, int64_t>& blobs) const {
  for (const std::shared_ptr<Job>& job : All()) {
    if (job->owner() != owner) continue;
    const v1::SolveJob record = job->Get();
    for (const v1::Digest& digest :
         {record.patch_set_digest(), record.latest_snapshot().payload_digest()}) {
      if (!digest.sha256().empty()) blobs[digest.sha256()] = digest.size_bytes();
    }
  }
}

absl::Status JobStore::Save(const Job& job, std::vector<RecordChange> changes) {
  return Save(job, job.Get(), job.snapshots(), std::move(changes));
}

absl::Status JobStore::Update(Job& job, const std::function<void(v1::SolveJob&)>& change,
                              std::vector<RecordChange> changes) {
  v1::SolveJob record = job.Get();
  change(record);
  absl::Status saved = Save(job, record, job.snapshots(), std::move(changes));
  if (saved.ok()) job.Update(change);
  return saved;
}

absl::Status JobStore::Publish(Job& job, const v1::Snapshot& snapshot,
                               std::vector<RecordChange> changes) {
  v1::SolveJob record = job.Get();
  const v1::Snapshot old = record.latest_snapshot();
  *record.mutable_latest_snapshot() = snapshot;
  *record.mutable_progress() = snapshot.progress();
  std::vector<v1::Snapshot> snapshots = job.snapshots();
  snapshots.push_back(snapshot);
  absl::Status saved = Save(job, record, snapshots, std::move(changes));
  if (!saved.ok()) return saved;
  job.AddSnapshot(snapshot);
  if (!old.name().empty()) refs_->Release(old.payload_digest().sha256());
  return absl::OkStatus();
}

absl::Status JobStore::Save(const Job& job, const v1::SolveJob& record,
                            const std::vector<v1::Snapshot>& snapshots,
                            std::vector<RecordChange> changes) {
  if (!records_->keeps()) return absl::OkStatus();
  v1::ListSnapshotsResponse history;
  for (const v1::Snapshot& snapshot : snapshots) *history.add_snapshots() = snapshot;
  changes.push_back({kJobs, job.id(), record.SerializeAsString()});
  changes.push_back({kSnapshots, job.id(), history.SerializeAsString()});
  return records_->Commit(changes);
}

}  // namespace lambert::server
