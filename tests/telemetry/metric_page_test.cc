#include "telemetry/metric_page.h"

#include <gtest/gtest.h>

namespace lambert {
namespace {

TEST(MetricPage, HasOneHeadForAllLabelsOfAName) {
  MetricPage page;
  page.Gauge("lambert_leases", "Units that workers hold.", 3);
  page.Counter("lambert_results_total", "Results.", 2, {{"outcome", "accepted"}});
  page.Counter("lambert_results_total", "Results.", 1, {{"outcome", "refused"}});
  EXPECT_EQ(page.Text(),
            "# HELP lambert_leases Units that workers hold.\n"
            "# TYPE lambert_leases gauge\n"
            "lambert_leases 3\n"
            "# HELP lambert_results_total Results.\n"
            "# TYPE lambert_results_total counter\n"
            "lambert_results_total{outcome=\"accepted\"} 2\n"
            "lambert_results_total{outcome=\"refused\"} 1\n");
}

}  // namespace
}  // namespace lambert
