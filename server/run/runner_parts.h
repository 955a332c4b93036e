// What jobs and gathers are run with.
#pragma once

#include "radiosity/core/log.h"
#include "server/base/clock.h"
#include "server/blobs/blob_refs.h"
#include "server/blobs/blob_store.h"
#include "server/doors/holdings.h"
#include "server/jobs/job_store.h"
#include "server/run/journal_executor.h"
#include "server/scenes/scene_store.h"
#include "server/work/work_table.h"

namespace lambert::server {

// All of it outlives who runs them and is thread safe.
struct RunnerParts {
  BlobStore* blobs = nullptr;
  BlobRefs* refs = nullptr;
  RecordStore* records = nullptr;
  SceneStore* scenes = nullptr;
  JobStore* jobs = nullptr;
  const Holdings* holdings = nullptr;
  Quotas* quotas = nullptr;
  WorkTable* work = nullptr;
  int64_t max_patches = 0;
  JournalMode journal = JournalMode::kAuto;
  Clock clock;
  Log log;
};

}  // namespace lambert::server
