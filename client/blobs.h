// Bytes to and from a server, by digest.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "client/caller.h"
#include "client/job.h"
#include "lambert/v1/blob_service.grpc.pb.h"

namespace lambert::client {

// Bytes of all files done, and bytes of all files.
using UploadProgress = std::function<void(int64_t, int64_t)>;

// Any thread. `caller` outlives the object.
class Blobs {
 public:
  Blobs(v1::BlobService::StubInterface* stub, Caller* caller) : stub_(stub), caller_(caller) {}

  // Sends those of `files` that the server lacks, in chunks of 1 MiB; an upload that breaks off
  // goes on where it broke. Bytes that are there already count as done at once.
  absl::Status Upload(const std::vector<const std::string*>& files,
                      const UploadProgress& on_progress);

  // Fetches a blob and checks its digest: DATA_LOSS (reason BLOB_CORRUPT) where it differs. A
  // download that breaks off goes on from its next byte. `what` names it in messages.
  absl::StatusOr<std::string> Download(const BlobRef& blob, const std::string& what);

 private:
  absl::Status UploadOne(const v1::Digest& digest, const std::string& bytes,
                         const std::function<void(int64_t)>& on_progress);

  v1::BlobService::StubInterface* const stub_;
  Caller* const caller_;
};

}  // namespace lambert::client
