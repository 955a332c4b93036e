// All jobs, in memory and as records.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "lambert/v1/scene_service.pb.h"
#include "lambert/v1/solve_job_service.pb.h"
#include "server/base/pages.h"
#include "server/base/record_store.h"
#include "server/blobs/blob_refs.h"
#include "server/doors/identity.h"
#include "server/doors/quotas.h"
#include "server/jobs/job.h"

namespace lambert::server {

// Thread safe.
class JobStore {
 public:
  // `max_waiting`: jobs that have not ended, > 0; more: TOO_MANY_JOBS.
  JobStore(BlobRefs* refs, RecordStore* records, const Quotas* quotas, int max_waiting);

  // Finds the jobs of an earlier run again; returns those that have not ended, queued, and refers
  // to all blobs that they need. RECORD_CORRUPT. Call it before anything else.
  absl::StatusOr<std::vector<std::shared_ptr<Job>>> Restore();

  struct Created {
    std::shared_ptr<Job> job;
    bool is_new = false;
  };
  // Makes a queued job, or finds the one that the same request made. Requires: the scene is there
  // and the spec valid. FIELD_INVALID, JOB_ID_TAKEN, TOO_MANY_JOBS, QUOTA_EXCEEDED, STORE_FULL.
  absl::StatusOr<Created> Create(const v1::CreateSolveJobRequest& request, const v1::Scene& scene,
                                 const std::string& unit_version);
  // JOB_NOT_FOUND, also where the caller does not see it.
  absl::StatusOr<std::shared_ptr<Job>> Find(const std::string& name, const Identity& who) const;
  absl::StatusOr<Page<std::shared_ptr<Job>>> List(int page_size, const std::string& page_token,
                                                  const Identity& who) const;
  std::vector<std::shared_ptr<Job>> All() const;
  // Releases the job's blobs. JOB_NOT_FOUND, JOB_NOT_ENDED, and what RecordStore::Commit fails
  // with: then the job stays.
  absl::Status Delete(const std::string& name, const Identity& who);
  // True while a job of `owner` that has not ended solves the scene.
  bool UsesScene(const std::string& scene, const std::string& owner) const;
  // Whether a job that runs is solved on this patch set.
  bool IsPatchSetOfRunning(const std::string& sha256) const;
  // Adds the patch sets and solutions of jobs of `owner`, with their sizes.
  void AddBlobsOf(const std::string& owner, std::map<std::string, int64_t>& blobs) const;

  // Writes a job's record and the descriptions of its snapshots, and makes `changes`, in one
  // transaction. STORE_FULL.
  absl::Status Save(const Job& job, std::vector<RecordChange> changes = {});
  // Stores the record as `change` makes it, and then changes it for those who watch; where that
  // fails, nothing is changed.
  absl::Status Update(Job& job, const std::function<void(v1::SolveJob&)>& change,
                      std::vector<RecordChange> changes);
  // The same with one more snapshot, which watchers are told of once it is stored. Releases the
  // payload of the one before. Requires: the payload is stored and referenced.
  absl::Status Publish(Job& job, const v1::Snapshot& snapshot, std::vector<RecordChange> changes);

 private:
  absl::Status Save(const Job& job, const v1::SolveJob& record,
                    const std::vector<v1::Snapshot>& snapshots, std::vector<RecordChange> changes);

  BlobRefs* const refs_;
  RecordStore* const records_;
  const Quotas* const quotas_;
  const int max_waiting_;
  mutable absl::Mutex mutex_;
  std::map<std::string, std::shared_ptr<Job>> jobs_ ABSL_GUARDED_BY(mutex_);  // by name
};

}  // namespace lambert::server
