#include "server/stream/watch_cursor.h"

#include <algorithm>
#include <utility>

namespace lambert::server {
namespace {

constexpr size_t kChunkBytes = size_t{1} << 20;

}  // namespace

WatchCursor::WatchCursor(std::shared_ptr<Job> job, BlobStore* blobs,
                         const v1::WatchSnapshotsRequest& request)
    : job_(std::move(job)),
      blobs_(blobs),
      full_(request.view() == v1::SNAPSHOT_VIEW_FULL),
      version_(request.last_version()) {}

// False where the payload has gone: a newer snapshot is there by now.
bool WatchCursor::StartSnapshot(const v1::Snapshot& snapshot) {
  if (!full_) return true;
  absl::StatusOr<std::shared_ptr<const Blob>> blob =
      blobs_->Get(snapshot.payload_digest().sha256());
  if (!blob.ok()) return false;
  payload_ = *std::move(blob);
  payload_offset_ = 0;
  return true;
}

std::optional<v1::WatchSnapshotsResponse> WatchCursor::Next() {
  v1::WatchSnapshotsResponse message;
  if (done_) return std::nullopt;
  if (payload_ != nullptr) {
    const absl::string_view rest = payload_->bytes().substr(payload_offset_);
    const size_t size = std::min(rest.size(), kChunkBytes);
    message.set_payload_chunk(rest.data(), size);
    payload_offset_ += size;
    if (size == rest.size()) payload_.reset();
    return message;
  }
  const Job::News news = job_->GetNews();
  if (news.snapshot.version() > version_ && StartSnapshot(news.snapshot)) {
    version_ = news.snapshot.version();
    *message.mutable_snapshot() = news.snapshot;
    return message;
  }
  if (news.ended) {
    *message.mutable_job_ended() = job_->Get();
    done_ = true;
    return message;
  }
  if (news.progress_count > progress_count_) {
    progress_count_ = news.progress_count;
    *message.mutable_progress() = news.progress;
    return message;
  }
  return std::nullopt;
}

}  // namespace lambert::server
