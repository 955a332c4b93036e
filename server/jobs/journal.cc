#include "server/jobs/journal.h"

#include <algorithm>
#include <utility>

#include "radiosity/core/digest.h"

namespace lambert::server {
namespace {

// Of everything that a step's result depends on, beside patch set and options.
std::string DigestOfUnits(const std::vector<WorkUnit>& units) {
  std::string digests;
  for (const WorkUnit& unit : units) digests += Sha256Hex(EncodeUnit(unit));
  return Sha256Hex(digests);
}

}  // namespace

std::vector<std::string> BlobsOf(const store::v1::ResumePoint& point) {
  std::vector<std::string> blobs;
  if (point.has_checkpoint_digest()) blobs.push_back(point.checkpoint_digest().sha256());
  for (const store::v1::FinishedStep& step : point.steps()) {
    blobs.push_back(step.result_digest().sha256());
  }
  return blobs;
}

Journal::Journal(std::string job_id, BlobStore* blobs, BlobRefs* refs, RecordStore* records)
    : job_id_(std::move(job_id)), blobs_(blobs), refs_(refs), records_(records) {}

absl::Status Journal::Load() {
  absl::StatusOr<std::string> bytes = records_->Load(kResumePoints, job_id_);
  if (absl::IsNotFound(bytes.status())) return absl::OkStatus();
  if (!bytes.ok()) return bytes.status();
  if (!point_.ParseFromString(*bytes)) return DamagedRecord(kResumePoints, job_id_);
  is_resumed_ = true;
  return absl::OkStatus();
}

absl::StatusOr<std::string> Journal::Checkpoint() const {
  if (!point_.has_checkpoint_digest()) return std::string();
  absl::StatusOr<std::shared_ptr<const Blob>> blob =
      blobs_->Get(point_.checkpoint_digest().sha256());
  if (!blob.ok()) return blob.status();
  return std::string((*blob)->bytes());
}

bool Journal::IsPast(const WorkUnit& unit) const {
  // Not in order: a step that was left out is added when it is shot again.
  return std::none_of(point_.steps().begin(), point_.steps().end(), [&](const auto& step) {
    return std::pair<int64_t, int64_t>(unit.pass, unit.step) <=
           std::pair<int64_t, int64_t>(step.pass(), step.step());
  });
}

std::optional<UnitResult> Journal::Find(const std::vector<WorkUnit>& units,
                                        PatchIndex patch_count) const {
  for (const store::v1::FinishedStep& step : point_.steps()) {
    if (step.pass() != static_cast<int32_t>(units.front().pass) ||
        step.step() != static_cast<int32_t>(units.front().step) ||
        step.units_sha256() != DigestOfUnits(units)) {
      continue;
    }
    absl::StatusOr<std::shared_ptr<const Blob>> blob = blobs_->Get(step.result_digest().sha256());
    if (!blob.ok()) return std::nullopt;
    absl::StatusOr<UnitResult> result =
        DecodeUnitResult(std::string((*blob)->bytes()), patch_count);
    if (!result.ok()) return std::nullopt;
    result->cpu_seconds = step.cpu_seconds();
    return *std::move(result);
  }
  return std::nullopt;
}

absl::Status Journal::Add(const std::vector<WorkUnit>& units, const UnitResult& result) {
  absl::StatusOr<v1::Digest> digest = Put(EncodeUnitResult(result));
  if (!digest.ok()) return digest.status();
  store::v1::ResumePoint longer = point_;
  store::v1::FinishedStep* step = longer.add_steps();
  step->set_pass(static_cast<int32_t>(units.front().pass));
  step->set_step(static_cast<int32_t>(units.front().step));
  step->set_units_sha256(DigestOfUnits(units));
  *step->mutable_result_digest() = *digest;
  step->set_cpu_seconds(result.cpu_seconds);
  absl::Status stored = records_->Commit({Change(longer)});
  if (stored.ok()) {
    point_ = std::move(longer);
  } else if (!IsOwnershipLost(stored)) {  // else it may stand in the database after all
    refs_->Release(digest->sha256());
  }
  return stored;
}

absl::StatusOr<RecordChange> Journal::Replace(const std::string& checkpoint) {
  absl::StatusOr<v1::Digest> digest = Put(checkpoint);
  if (!digest.ok()) return digest.status();
  Abandon();
  *next_.mutable_checkpoint_digest() = *digest;
  return Change(next_);
}

RecordChange Journal::Clear() {
  Abandon();
  return {kResumePoints, job_id_, std::nullopt};
}

void Journal::Abandon() {
  for (const std::string& blob : BlobsOf(next_)) refs_->Release(blob);
  next_.Clear();
}

void Journal::Settle() {
  for (const std::string& blob : BlobsOf(point_)) refs_->Release(blob);
  point_ = std::exchange(next_, {});
}

absl::StatusOr<v1::Digest> Journal::Put(std::string bytes) {
  v1::Digest digest;
  digest.set_sha256(Sha256Hex(bytes));
  digest.set_size_bytes(static_cast<int64_t>(bytes.size()));
  refs_->Add(digest.sha256());
  if (absl::Status stored = blobs_->Put(digest.sha256(), std::move(bytes)); !stored.ok()) {
    refs_->Release(digest.sha256());
    return stored;
  }
  return digest;
}

RecordChange Journal::Change(const store::v1::ResumePoint& point) const {
  return {kResumePoints, job_id_, point.SerializeAsString()};
}

}  // namespace lambert::server
