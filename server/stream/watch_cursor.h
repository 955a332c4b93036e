// How far one watcher is: turns a job's newest state into the next message.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "lambert/v1/snapshot_service.pb.h"
#include "server/blobs/blob_store.h"
#include "server/jobs/job.h"

namespace lambert::server {

// One thread at a time. It holds at most the one payload that is being sent, so a slow watcher
// costs no more than that and gets the newest snapshot next.
class WatchCursor {
 public:
  WatchCursor(std::shared_ptr<Job> job, BlobStore* blobs, const v1::WatchSnapshotsRequest& request);

  // The next message, or nothing while there is no news. After `job_ended` there is none.
  std::optional<v1::WatchSnapshotsResponse> Next();
  bool done() const { return done_; }

 private:
  bool StartSnapshot(const v1::Snapshot& snapshot);

  const std::shared_ptr<Job> job_;
  BlobStore* const blobs_;
  const bool full_;
  int64_t version_;              // that was sent, or is being sent
  int64_t progress_count_ = -1;  // that was sent
  bool done_ = false;
  std::shared_ptr<const Blob> payload_;  // null: none is being sent
  size_t payload_offset_ = 0;
};

}  // namespace lambert::server
