#include "app/bench_figures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "app/bench_costs.h"
#include "app/bench_text.h"
#include "app/gnuplot.h"
#include "fmt/format.h"
#include "radiosity/output/output_file.h"

namespace lambert::app {
namespace {

// A column of errors.dat, and how an axis shows it.
struct Column {
  int number;         // in the file, from 1
  const char* title;  // of the axis
  double (*value)(const BenchSummary&);
};

double OrNan(const std::optional<double>& value) {
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

constexpr Column kRays{1, "rays", [](const BenchSummary& s) { return s.rays; }};
constexpr Column kCpu{2, "CPU seconds of the workers",
                      [](const BenchSummary& s) { return s.cpu_seconds; }};
constexpr Column kWall{3, "seconds by the clock", [](const BenchSummary& s) { return s.seconds; }};
constexpr Column kArea{4, "RMS error, weighted by area",
                       [](const BenchSummary& s) { return OrNan(s.measures.rms_area); }};
constexpr Column kPatch{5, "RMS error, every patch alike",
                        [](const BenchSummary& s) { return OrNan(s.measures.rms_patch); }};
constexpr Column kLocal{6, "RMS error of the region",
                        [](const BenchSummary& s) { return OrNan(s.measures.rms_local); }};
constexpr Column kColumns[] = {kRays, kCpu, kWall, kArea, kPatch, kLocal};

struct Panel {
  Column x, y;
  std::optional<double> residual;  // of the reference, in the unit of y
};

struct Figure {
  std::string name, title;
  std::vector<std::vector<Panel>> rows;
  bool logarithmic = true;
};

struct Range {
  double low, high;
};

// Layout, pixels.
constexpr int kPanelWidth = 400, kPanelHeight = 320;
constexpr int kLeft = 84, kRight = 20, kTop = 64, kBottom = 64;
constexpr int kLegendSample = 70, kLegendCharacter = 8;

std::vector<std::string> Methods(const BenchResult& result) {
  std::vector<std::string> methods;
  for (const BenchEntry& entry : result.entries) methods.push_back(entry.label);
  return methods;
}

// One block for each method, its lines by rays: what `index` picks.
std::string ErrorData(const BenchResult& result) {
  std::string text = "# rays cpu_seconds seconds rms_area rms_patch rms_local\n";
  for (const std::string& method : Methods(result)) {
    std::vector<const BenchSummary*> lines;
    for (const BenchSummary& summary : result.summaries) {
      if (summary.method == method) lines.push_back(&summary);
    }
    std::sort(lines.begin(), lines.end(),
              [](const BenchSummary* a, const BenchSummary* b) { return a->rays < b->rays; });
    text += "# " + method + "\n";
    for (const BenchSummary* line : lines) {
      for (const Column& column : kColumns) text += fmt::format("{:.9g} ", column.value(*line));
      text += "\n";
    }
    text += "\n\n";
  }
  return text;
}

// Round numbers people can read: 5k, 200M; 0.5 % as errors.
std::string RaysLabel(double rays) {
  if (rays >= 1e9) return fmt::format("{:g}G", rays / 1e9);
  if (rays >= 1e6) return fmt::format("{:g}M", rays / 1e6);
  return rays >= 1e3 ? fmt::format("{:g}k", rays / 1e3) : fmt::format("{:g}", rays);
}

// A format of gnuplot: a percent sign is doubled.
std::string TicLabel(const Column& column, double value) {
  if (column.number == kRays.number) return RaysLabel(value);
  const bool is_error = column.number >= kArea.number;
  return is_error ? fmt::format("{:g} %%", 100 * value) : fmt::format("{:g}", value);
}

Range RangeOf(const BenchResult& result, const Column& column, std::optional<double> residual,
              bool logarithmic) {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  const auto add = [&](double value) {
    if (!(value > 0) || !std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  };
  for (const BenchSummary& summary : result.summaries) add(column.value(summary));
  if (residual) add(*residual);
  if (!(high > 0)) return {0.1, 1};
  return logarithmic ? Range{low / 1.35, high * 1.35} : Range{0, high * 1.06};
}

// Logarithmic: 1, 2 and 5 times powers of ten, powers alone over three decades. Linear: about six
// round steps from 0.
std::vector<double> Tics(const Range& range, bool logarithmic) {
  std::vector<double> tics;
  if (!logarithmic) {
    const double power = std::pow(10, std::floor(std::log10(range.high / 6)));
    double step = power;
    for (double digit : {2.0, 5.0, 10.0}) {
      if (range.high / step > 6) step = digit * power;
    }
    for (int k = 0; k * step <= range.high; ++k) tics.push_back(k * step);
    return tics;
  }
  const bool wide = range.high / range.low > 1000;
  for (int power = -15; power <= 18; ++power) {
    for (double digit : {1.0, 2.0, 5.0}) {
      const double value = digit * std::pow(10, power);
      if (value < range.low || value > range.high || (wide && digit > 1)) continue;
      tics.push_back(value);
    }
  }
  return tics;
}

std::string Axis(const char* axis, const Column& column, const Range& range, bool logarithmic) {
  std::string text = fmt::format("set {0}label '{1}'\nset {0}range [{2:.6g}:{3:.6g}]\n", axis,
                                 column.title, range.low, range.high);
  text += fmt::format("{} logscale {}\nset {}tics (", logarithmic ? "set" : "unset", axis, axis);
  const char* separator = "";
  for (double tic : Tics(range, logarithmic)) {
    text += fmt::format("{}'{}' {:.6g}", separator, TicLabel(column, tic), tic);
    separator = ", ";
  }
  return text + ")\n";
}

// The factor of a guide c / sqrt(x) that passes over all points.
double GuideFactor(const BenchResult& result, const Panel& panel) {
  double factor = 0;
  for (const BenchSummary& s : result.summaries) {
    const double here = panel.y.value(s) * std::sqrt(panel.x.value(s));
    if (std::isfinite(here)) factor = std::max(factor, here);
  }
  return 1.15 * factor;
}

std::string PlotCommand(const BenchResult& result, const Figure& figure, const Panel& panel) {
  std::string text = "plot ";
  const std::vector<std::string> methods = Methods(result);
  for (size_t k = 0; k < methods.size(); ++k) {
    text += fmt::format("'errors.dat' index {} using {}:{} with linespoints lt {} title {}, \\\n  ",
                        k, panel.x.number, panel.y.number, k + 1, GnuplotQuoted(methods[k]));
  }
  if (panel.residual && *panel.residual > 0) {
    text += fmt::format(
        "{:.6g} with lines lc rgb '#555555' lw 1.3 dt 2 title 'residual of the reference', \\\n  ",
        *panel.residual);
  }
  if (!figure.logarithmic) return text + "NaN notitle\n";
  return text +
         fmt::format("{:.6g}/sqrt(x) with lines lc rgb '#999999' lw 1.3 dt 3 title 'slope -1/2'\n",
                     GuideFactor(result, panel));
}

// The size of a figure, pixels.
struct Layout {
  int columns, rows, width, height;
};

constexpr int kCellWidth = kLeft + kPanelWidth + kRight, kCellHeight = kPanelHeight + kBottom;

Layout LayoutOf(const BenchResult& result, const Figure& figure) {
  size_t longest = sizeof("residual of the reference");
  for (const std::string& method : Methods(result)) longest = std::max(longest, method.size());
  const int columns = static_cast<int>(figure.rows.front().size());
  const int rows = static_cast<int>(figure.rows.size());
  const int legend = kLegendSample + static_cast<int>(longest) * kLegendCharacter;
  const int width =
      std::max(columns * kCellWidth + legend, GnuplotTextWidth(BenchHeadline(result)));
  return {columns, rows, width, kTop + rows * kCellHeight};
}

// Legend and headline belong to the first panel and stand beside all of them.
std::string Surroundings(const BenchResult& result, const Figure& figure, const Layout& layout) {
  return GnuplotTerminal(figure.name, layout.width, layout.height) + GnuplotLineTypes() +
         GnuplotHeadline(figure.title, BenchHeadline(result), kLeft, layout.width, layout.height) +
         fmt::format(
             "set key at screen {:.5f},{:.5f} left top vertical Left reverse noenhanced samplen 3 "
             "spacing 1.25\n",
             static_cast<double>(layout.columns) * kCellWidth / layout.width,
             1 - static_cast<double>(kTop) / layout.height);
}

std::string PanelScript(const BenchResult& result, const Figure& figure, const Layout& layout,
                        int row, int column) {
  const Panel& panel = figure.rows[row][column];
  const bool log = figure.logarithmic;
  const bool is_first = row == 0 && column == 0;
  return (is_first ? "\n" : "\nunset key\nunset label\n") +
         GnuplotPlace(column * kCellWidth + kLeft, kTop + row * kCellHeight, kPanelWidth,
                      kPanelHeight, layout.width, layout.height) +
         Axis("x", panel.x, RangeOf(result, panel.x, std::nullopt, log), log) +
         Axis("y", panel.y, RangeOf(result, panel.y, panel.residual, log), log) +
         PlotCommand(result, figure, panel);
}

std::string FigureScript(const BenchResult& result, const Figure& figure) {
  const Layout layout = LayoutOf(result, figure);
  std::string text = Surroundings(result, figure, layout);
  for (int row = 0; row < layout.rows; ++row) {
    for (int column = 0; column < layout.columns; ++column) {
      text += PanelScript(result, figure, layout, row, column);
    }
  }
  return text + "unset multiplot\nset output\n";
}

std::vector<Figure> ErrorFigures(const BenchResult& result) {
  const ErrorMeasures& residual = result.reference.residual;
  const bool local = std::any_of(result.summaries.begin(), result.summaries.end(),
                                 [](const BenchSummary& s) { return s.measures.rms_local; });
  const auto row = [&](const Column& x) {
    std::vector<Panel> panels = {{x, kArea, residual.rms_area}, {x, kPatch, residual.rms_patch}};
    if (local) panels.push_back({x, kLocal, residual.rms_local});
    return panels;
  };
  std::vector<Figure> figures = {
      {"error_rays", "Error against rays", {row(kRays)}, true},
      {"error_time", "Error against time", {row(kCpu), row(kWall)}, true},
      {"figure9",
       "Global RMS error, as in figure 9 of the paper",
       {{{kRays, kPatch, residual.rms_patch}}},
       false}};
  if (local) {
    figures.push_back({"figure10",
                       "Local RMS error, as in figure 10 of the paper",
                       {{{kRays, kLocal, residual.rms_local}}},
                       false});
  }
  return figures;
}

}  // namespace

absl::StatusOr<std::vector<std::string>> DrawFigures(const BenchResult& result,
                                                     const std::string& folder) {
  if (absl::Status status = MakeOutputFolder(folder); !status.ok()) return status;
  std::vector<std::string> names, pictures;
  std::map<std::string, std::string> files = {{"errors.dat", ErrorData(result)},
                                              {"costs.dat", CostData(result)},
                                              {"costs.gp", CostScript(result)}};
  for (const Figure& figure : ErrorFigures(result)) {
    files[figure.name + ".gp"] = FigureScript(result, figure);
    names.push_back(figure.name);
  }
  names.emplace_back("costs");
  for (const auto& [name, text] : files) {
    absl::Status status = WriteOutputFile(folder + "/" + name, text);
    if (!status.ok()) return status;
  }
  for (const std::string& name : names) {
    absl::Status status = RunGnuplot(folder, name + ".gp", {"png", "svg"});
    if (!status.ok()) return status;
    for (const char* ending : {".png", ".svg"}) pictures.push_back(folder + "/" + name + ending);
  }
  return pictures;
}

}  // namespace lambert::app
