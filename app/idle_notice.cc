#include "app/idle_notice.h"

namespace lambert::app {
namespace {

// Shorter standstills are how workers start, and how large scenes are cut into patches.
constexpr double kStandstill_s = 3;

}  // namespace

void IdleNotice::Check(const Progress& progress) {
  const double now_s = MonotonicSeconds();
  if (progress.rays != rays_) {
    rays_ = progress.rays;
    moved_at_s_ = now_s;
    told_ = false;
  }
  if (told_ || now_s - moved_at_s_ < kStandstill_s) return;
  const auto workers = client_->ListWorkers();
  if (!workers.ok() || !workers->empty()) return;
  told_ = true;
  printer_->Note("waiting: no worker is connected; start one with: lambert-worker --server " +
                 server_);
}

}  // namespace lambert::app
