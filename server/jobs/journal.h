// What an interrupted job goes on from: its last checkpoint, and the steps that ended since.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "lambert/store/v1/resume_point.pb.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/shoot/unit.h"
#include "server/base/record_store.h"
#include "server/blobs/blob_refs.h"
#include "server/blobs/blob_store.h"

namespace lambert::server {

// Where a job's resume point stands in the record store, under the job's id.
inline constexpr char kResumePoints[] = "resume";

// The digests of all blobs that a resume point names.
std::vector<std::string> BlobsOf(const store::v1::ResumePoint& point);

// The resume point of one job, while it runs. One thread. Bytes are blobs, stored before the record
// that names them; the record is small.
class Journal {
 public:
  // Requires: the blobs that the stored resume point names, if any, are referenced (JobStore).
  Journal(std::string job_id, BlobStore* blobs, BlobRefs* refs, RecordStore* records);

  // Reads what an earlier run of the server left. RECORD_CORRUPT.
  absl::Status Load();
  // False where nothing outlasts the process: then nothing need be added.
  bool keeps() const { return records_->keeps(); }
  // The solver's state after its last checkpointed pass; "" where there is none. BLOB_NOT_FOUND.
  absl::StatusOr<std::string> Checkpoint() const;
  // True where Load found something.
  bool is_resumed() const { return is_resumed_; }
  // True for units of a step after all that are kept.
  bool IsPast(const WorkUnit& unit) const;

  // The result of a step that was asked for the same units; nullopt where it is not known, or can
  // no longer be read: shooting again gives the same.
  std::optional<UnitResult> Find(const std::vector<WorkUnit>& units, PatchIndex patch_count) const;
  // Keeps the result of a step. Returns when it outlasts a crash. STORE_FULL and other errors of
  // the stores: then the step is not kept.
  absl::Status Add(const std::vector<WorkUnit>& units, const UnitResult& result);

  // Stores a checkpoint, from which all steps so far are left behind. The change belongs into the
  // transaction that stores the pass; after it, Settle, or nothing where it failed. STORE_FULL.
  absl::StatusOr<RecordChange> Replace(const std::string& checkpoint);
  // The change that forgets everything, for the transaction that ends the job; after it, Settle.
  RecordChange Clear();
  // Lets the blobs go that the last change left behind.
  void Settle();

 private:
  // Refers to a blob, and stores it.
  absl::StatusOr<v1::Digest> Put(std::string bytes);
  // Forgets a change that was not made.
  void Abandon();
  RecordChange Change(const store::v1::ResumePoint& point) const;

  const std::string job_id_;
  BlobStore* const blobs_;
  BlobRefs* const refs_;
  RecordStore* const records_;
  bool is_resumed_ = false;
  store::v1::ResumePoint point_, next_;  // as stored; as it is after the change under way
};

}  // namespace lambert::server
