#include "app/bench_costs.h"

#include <algorithm>

#include "app/bench_text.h"
#include "app/gnuplot.h"
#include "fmt/format.h"

namespace lambert::app {
namespace {

// Layout, pixels. Every method has a line of bars, and its name stands to the left of them.
constexpr int kTop = 92, kBottom = 20, kRight = 76, kGap = 14;
constexpr int kBarHeight = 26, kPlotWidth = 260, kNameCharacter = 8, kNameMargin = 24;

double MemoryMiB(const BenchSummary& summary) {
  const int64_t bytes = summary.peak_rss_bytes.value_or(summary.planned_worker_bytes);
  return static_cast<double>(bytes) / (1 << 20);
}

double FirstRaysMs(const BenchSummary& summary) { return 1e3 * summary.setup_s; }

double CpuSecondsPerMray(const BenchSummary& summary) {
  return 1e6 * summary.cpu_seconds / std::max(summary.rays, 1.0);
}

struct CostPlot {
  const char* title;
  int column;  // of costs.dat
  double (*value)(const BenchSummary&);
};
constexpr CostPlot kPlots[] = {{"peak memory, MiB", 2, MemoryMiB},
                               {"time to the first rays, ms", 3, FirstRaysMs},
                               {"CPU time of a million rays, s", 4, CpuSecondsPerMray}};

double LargestOf(const std::vector<const BenchSummary*>& runs, const CostPlot& plot) {
  double largest = 1e-9;
  for (const BenchSummary* run : runs) largest = std::max(largest, plot.value(*run));
  return largest;
}

// Of each method the line with the most rays.
std::vector<const BenchSummary*> LargestRuns(const BenchResult& result) {
  std::vector<const BenchSummary*> runs;
  for (const BenchEntry& entry : result.entries) {
    const BenchSummary* largest = nullptr;
    for (const BenchSummary& summary : result.summaries) {
      if (summary.method != entry.label) continue;
      if (largest == nullptr || summary.rays > largest->rays) largest = &summary;
    }
    if (largest != nullptr) runs.push_back(largest);
  }
  return runs;
}

}  // namespace

std::string CostData(const BenchResult& result) {
  std::string text =
      "# method memory_MiB first_rays_ms cpu_seconds_per_Mray; memory: of this process at its "
      "peak, or of one worker as planned where the work was done elsewhere\n";
  for (const BenchSummary* run : LargestRuns(result)) {
    text += "\"" + run->method + "\"";
    for (const CostPlot& plot : kPlots) text += fmt::format(" {:.6g}", plot.value(*run));
    text += "\n";
  }
  return text;
}

std::string CostScript(const BenchResult& result) {
  const std::vector<const BenchSummary*> runs = LargestRuns(result);
  size_t longest = 6;
  for (const BenchSummary* run : runs) longest = std::max(longest, run->method.size());
  int left = kNameMargin + static_cast<int>(longest) * kNameCharacter;
  const int bars = kBarHeight * (static_cast<int>(runs.size()) + 1);
  const int width =
      std::max(left + (kPlotWidth + kRight + kGap) * static_cast<int>(std::size(kPlots)),
               GnuplotTextWidth(BenchHeadline(result)));
  const int height = kTop + bars + kBottom;
  std::string text =
      GnuplotTerminal("costs", width, height) + GnuplotLineTypes() +
      GnuplotHeadline("Costs at the largest budget", BenchHeadline(result), kNameMargin, width,
                      height) +
      "set style fill solid 0.85 noborder\nunset key\nunset grid\nunset xtics\nset border 2\n" +
      fmt::format("set yrange [{}.6:-0.6]\nset ytics noenhanced scale 0\n",
                  std::max<size_t>(runs.size(), 1) - 1);
  const char* names = ":ytic(1)";
  for (const CostPlot& plot : kPlots) {
    text += "\n" + GnuplotPlace(left, kTop, kPlotWidth, bars, width, height);
    text += fmt::format(
        "set title '{0}'\nset xrange [0:{3:.6g}]\n"
        "plot 'costs.dat' using (0):0:(0):{1}:($0-0.36):($0+0.36):($0+1){2} with boxxyerror lc "
        "variable, \\\n     '' using {1}:0:(sprintf('%.3g', ${1})) with labels left offset 0.6,0\n"
        "unset label\nunset ytics\n",
        plot.title, plot.column, names, LargestOf(runs, plot));
    names = "";
    left += kPlotWidth + kRight + kGap;
  }
  return text + "unset multiplot\nset output\n";
}

}  // namespace lambert::app
