#include "client/gather.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "client/convert.h"
#include "client/status.h"
#include "radiosity/core/digest.h"
#include "radiosity/core/error.h"

namespace lambert::client {
namespace {

constexpr std::chrono::duration<double> kReadDeadline{5};
// The server reads points and solution before it answers.
constexpr std::chrono::duration<double> kCreateDeadline{120};
constexpr std::chrono::milliseconds kFirstPause{10}, kLongestPause{500};
constexpr int kMostAttempts = 5;  // of a gather that a server which started again has lost
constexpr size_t kPointsPerGather = size_t{1} << 18;

// One gather of at most kMaxGatherPoints.
class Part {
 public:
  Part(v1::GatherService::StubInterface& stub, Caller& caller, Blobs& blobs)
      : stub_(stub), caller_(caller), blobs_(blobs) {}

  absl::StatusOr<Gathered> Run(v1::CreateGatherRequest request, const std::string& points,
                               const std::function<void(double)>& on_progress) {
    request.mutable_points_digest()->set_sha256(Sha256Hex(points));
    request.mutable_points_digest()->set_size_bytes(static_cast<int64_t>(points.size()));
    absl::StatusOr<Gathered> gathered = absl::UnknownError("not tried");
    for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
      gathered = Try(request, points, on_progress);
      if (gathered.ok() || !IsLost(gathered.status())) break;
    }
    return gathered;
  }

 private:
  // What a server that started again, or cleaned up, has forgotten; and what it did not finish.
  static bool IsLost(const absl::Status& status) {
    const std::string reason = ReasonOf(status);
    return reason == "GATHER_NOT_FOUND" || reason == "BLOB_NOT_FOUND" || reason == "SHUTTING_DOWN";
  }

  absl::StatusOr<Gathered> Try(const v1::CreateGatherRequest& request, const std::string& points,
                               const std::function<void(double)>& on_progress) {
    absl::Status status = blobs_.Upload({&points}, [](int64_t, int64_t) {});
    if (!status.ok()) return status;
    v1::Gather gather;
    status = caller_.Call(request.parent(), kCreateDeadline, [&](auto& context) {
      return stub_.CreateGather(&context, request, &gather);
    });
    auto pause = kFirstPause;
    while (status.ok() && gather.state() == v1::Gather::STATE_RUNNING) {
      on_progress(gather.done_fraction());
      std::this_thread::sleep_for(pause);
      pause = std::min(2 * pause, kLongestPause);
      v1::GetGatherRequest question;
      question.set_name(gather.name());
      status = caller_.Call(request.parent(), kReadDeadline, [&](auto& context) {
        return stub_.GetGather(&context, question, &gather);
      });
    }
    if (!status.ok()) return status;
    if (gather.state() != v1::Gather::STATE_SUCCEEDED) {
      return FromRpcStatus(gather.error(), request.parent());
    }
    auto bytes = blobs_.Download(FromProto(gather.result_digest()), "gathered values");
    if (!bytes.ok()) return bytes.status();
    return DecodeGathered(*bytes);
  }

  v1::GatherService::StubInterface& stub_;
  Caller& caller_;
  Blobs& blobs_;
};

}  // namespace

absl::StatusOr<Gathered> GatherOver(v1::GatherService::StubInterface& stub, Caller& caller,
                                    Blobs& blobs, const std::string& job,
                                    const GatherPoints& points, const GatherOptions& options,
                                    const std::function<void(size_t, size_t)>& on_progress) {
  Gathered all;
  for (size_t begin = 0; begin < points.size(); begin += kPointsPerGather) {
    const size_t end = std::min(begin + kPointsPerGather, points.size());
    GatherPoints some;
    for (size_t i = begin; i < end; ++i) some.Add(points.position_m[i], points.normal[i]);
    v1::CreateGatherRequest request;
    request.set_parent(job);
    request.set_rays_per_point(options.rays_per_point);
    request.set_seed(static_cast<int64_t>(options.seed));
    request.set_first_point(static_cast<int64_t>(begin));
    absl::StatusOr<Gathered> part =
        Part(stub, caller, blobs).Run(request, EncodeGatherPoints(some), [&](double fraction) {
          const double done = fraction * static_cast<double>(end - begin);
          on_progress(begin + static_cast<size_t>(done), points.size());
        });
    if (!part.ok()) return part.status();
    if (part->irradiance_lx.size() != end - begin) {
      return MakeError(absl::StatusCode::kDataLoss,
                       {"GATHER_INVALID", job, "the server's values are not of these points",
                        "use programs of one version"});
    }
    std::ranges::copy(part->irradiance_lx, std::back_inserter(all.irradiance_lx));
    std::ranges::copy(part->std_error_lx, std::back_inserter(all.std_error_lx));
    on_progress(end, points.size());
  }
  return all;
}

}  // namespace lambert::client
