#include "server/run/job_steps.h"

#include "radiosity/shoot/options_codec.h"
#include "server/jobs/spec.h"

namespace lambert::server {
namespace {

WorkSetup SetupOf(const Job& job, PatchIndex patches, const ShootOptions& shoot) {
  const v1::Digest digest = job.Get().patch_set_digest();
  return {job.id(), digest.sha256(),           digest.size_bytes(),
          patches,  EncodeShootOptions(shoot), shoot.method == Method::kPhsAlpha};
}

}  // namespace

JobSteps::JobSteps(const RunnerParts& parts, Job& job, Journal& journal, PatchIndex patches,
                   const ShootOptions& shoot, const Progress& start)
    : parts_(parts),
      job_(job),
      table_(parts.work, SetupOf(job, patches, shoot)),
      executor_(&table_, &journal, parts.journal, patches, parts.clock,
                [this](const std::string& line) {
                  parts_.log({line, {.job = job_.name()}});
                }),
      charged_(start) {}

void JobSteps::OnStep(const Progress& progress) {
  job_.SetProgress(EncodeProgress(progress));
  parts_.quotas->Charge(job_.owner(), progress.rays - charged_.rays,
                        progress.cpu_seconds - charged_.cpu_seconds);
  charged_ = progress;
  absl::Status left = parts_.quotas->CheckWork(job_.owner());
  if (!left.ok()) parts_.work->AbortJob(job_.id(), left);
}

void JobSteps::LogSummary() const {
  if (const std::string summary = executor_.Summary(); !summary.empty()) {
    parts_.log({summary, {.job = job_.name()}});
  }
}

}  // namespace lambert::server
