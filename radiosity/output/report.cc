#include "radiosity/output/report.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "absl/strings/escaping.h"
#include "radiosity/output/chart.h"
#include "radiosity/output/number_text.h"
#include "radiosity/output/report_style.h"
#include "radiosity/output/surfaces.h"

namespace lambert {
namespace {

constexpr size_t kMostSurfaces = 30;  // rows of the table; the smallest are summed up

// 3 significant digits, thousands set apart: "13 073", "0.0312"; large ones as powers of ten.
std::string Quantity(double value) {
  if (!(std::abs(value) >= 1000) || std::abs(value) >= 1e9) return RoundedText(value, 3);
  std::string digits = std::to_string(std::llround(std::abs(value)));
  for (ptrdiff_t at = static_cast<ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3) {
    digits.insert(static_cast<size_t>(at), "\u202f");
  }
  return (value < 0 ? "-" : "") + digits;
}

std::string Percent(double ratio) { return RoundedText(100 * ratio, 3) + "\u2009%"; }

std::string Tile(const std::string& value, const std::string& label) {
  return "<div><b>" + EscapeHtml(value) + "</b><span>" + EscapeHtml(label) + "</span></div>";
}

std::string Cell(const std::string& text) { return "<td>" + EscapeHtml(text) + "</td>"; }
std::string NumberCell(const std::string& text) {
  return "<td class=\"n\">" + EscapeHtml(text) + "</td>";
}

// Column titles; those that begin with '#' stand over numbers.
std::string Head(std::initializer_list<std::string> titles) {
  std::string html = "<tr>";
  for (const std::string& title : titles) {
    html += title[0] == '#' ? "<th class=\"n\">" + EscapeHtml(title.substr(1)) + "</th>"
                            : "<th>" + EscapeHtml(title) + "</th>";
  }
  return html + "</tr>";
}

std::string Image(const std::string& png, const std::string& alt) {
  return "<img alt=\"" + EscapeHtml(alt) + "\" src=\"data:image/png;base64," +
         absl::Base64Escape(png) + "\">";
}

std::string Tiles(const RunRecord& record, const UnitNames& units) {
  const Progress& progress = record.snapshot.progress;
  std::string html = "<div class=\"tiles\">";
  html += Tile(progress.estimated_rms_area < 0 ? "not known" : Percent(progress.estimated_rms_area),
               "estimated error");
  html += Tile(Quantity(static_cast<double>(progress.rays)), "rays");
  html += Tile(RoundedText(progress.seconds, 3) + " s", "run time");
  html += Tile(Quantity(record.patches->size()), "patches");
  html += Tile(Quantity(Luminance(record.snapshot.solution->ledger.emitted)) + " " + units.flux,
               "emitted flux");
  return html + "</div>";
}

// The bar of colours with its numbers.
std::string Legend(const LuxScale& scale, const UnitNames& units) {
  constexpr double kLeft = 40, kWidth = 640;
  constexpr int kSlices = 80;
  std::string svg = "<svg viewBox=\"0 0 720 46\" role=\"img\" aria-label=\"scale\">";
  for (int k = 0; k < kSlices; ++k) {
    const Rgb color = FalseColor((k + 0.5) / kSlices);
    std::string rgb;
    for (int channel = 0; channel < 3; ++channel) {
      if (channel > 0) rgb += ",";
      rgb += std::to_string(SrgbByte(color[channel]));
    }
    // A little wider than its share: no seams between the slices.
    svg += "<rect x=\"" + RoundedText(kLeft + kWidth * k / kSlices, 6) + "\" y=\"4\" width=\"" +
           RoundedText(kWidth / kSlices + (k + 1 < kSlices ? 0.6 : 0), 6) +
           "\" height=\"14\" fill=\"rgb(" + rgb + ")\"/>";
  }
  for (double tick : scale.ticks_lx) {
    svg += "<text x=\"" + RoundedText(kLeft + kWidth * scale.Place(tick), 6) +
           "\" y=\"36\" text-anchor=\"middle\">" + EscapeHtml(Quantity(tick)) + "</text>";
  }
  return svg + "<text x=\"714\" y=\"16\" text-anchor=\"end\">" + units.irradiance + "</text></svg>";
}

std::string Pictures(const ReportPictures& pictures, const UnitNames& units) {
  return "<figure>" + Image(pictures.png, "the solved scene") + "<figcaption>Radiosity from " +
         EscapeHtml(pictures.view.origin) + "; exposure " +
         RoundedText(pictures.exposure.per_lm_per_m2, 3) + " per " + units.radiosity + " (EV " +
         RoundedText(Ev100Of(pictures.exposure.per_lm_per_m2), 3) + "), tone map " +
         ToneMapName(pictures.exposure.tone_map) +
         ".</figcaption></figure><h2>Irradiance</h2><figure>" +
         Image(pictures.false_color_png, "irradiance in false colours") +
         Legend(pictures.scale, units) + "</figure>";
}

std::string ErrorChart(const RunRecord& record) {
  ChartSeries estimate{"estimated", "estimate", {}, {}};
  ChartSeries truth{"against the reference", "true", {}, {}};
  double last_estimate = -1;
  for (const ConvergenceRow& row : record.convergence) {
    // Estimates change at the end of a pass; steps between repeat them.
    if (row.progress.estimated_rms_area != last_estimate) {
      last_estimate = row.progress.estimated_rms_area;
      estimate.x.push_back(row.progress.seconds);
      estimate.y.push_back(last_estimate);
    }
    if (row.measures.rms_area.has_value()) {
      truth.x.push_back(row.progress.seconds);
      truth.y.push_back(*row.measures.rms_area);
    }
  }
  const double wanted = record.plan.options.max_error;
  const std::string chart = LogLogChart({estimate, truth}, "seconds", "relative RMS error, by area",
                                        wanted, "wanted: " + RoundedText(100 * wanted, 3) + " %");
  std::string html = "<h2>Error against time</h2>";
  if (chart.empty()) return html + "<p class=\"soft\">Too few passes for a curve.</p>";
  return html + "<figure>" + chart + "</figure>";
}

std::string ReferenceTable(const RunRecord& record) {
  if (!record.measures.has_value()) return "";
  const ErrorMeasures& measures = *record.measures;
  const std::pair<const char*, std::optional<double>> rows[] = {
      {"RMS, weighted by area", measures.rms_area},
      {"RMS over patches", measures.rms_patch},
      {"RMS over the patches of the region", measures.rms_local},
      {"95th percentile of the relative error", measures.p95},
      {"Power bias", measures.power_bias}};
  std::string html = "<h2>Against the reference</h2><table>";
  for (const auto& [name, measure] : rows) {
    if (!measure.has_value()) continue;
    html += "<tr>" + Cell(name) + NumberCell(Percent(*measure)) + "</tr>";
  }
  return html + "</table>";
}

std::string SurfaceTable(const RunRecord& record, const UnitNames& units) {
  const std::vector<Surface> surfaces = ListSurfaces(*record.patches, *record.snapshot.solution);
  const std::string unit = std::string(" [") + units.irradiance + "]";
  std::string html = "<h2>Surfaces</h2><div class=\"scroll\"><table>" +
                     Head({"Node", "#Patches", "#Area [m2]", "#Reflectance", "#Mean" + unit,
                           "#Least" + unit, "#Most" + unit, "#Least / mean"});
  for (size_t k = 0; k < std::min(surfaces.size(), kMostSurfaces); ++k) {
    const Surface& surface = surfaces[k];
    html +=
        "<tr>" + Cell(surface.name) + NumberCell(Quantity(surface.patches)) +
        NumberCell(RoundedText(surface.area_m2, 3)) +
        NumberCell(RoundedText(surface.mean_reflectance, 2)) +
        NumberCell(Quantity(surface.mean_lx)) + NumberCell(Quantity(surface.least_lx)) +
        NumberCell(Quantity(surface.most_lx)) +
        NumberCell(surface.mean_lx > 0 ? RoundedText(surface.least_lx / surface.mean_lx, 2) : "") +
        "</tr>";
  }
  html += "</table></div><p class=\"note\">Irradiance per patch";
  if (surfaces.size() > kMostSurfaces) {
    html += "; the " + std::to_string(kMostSurfaces) + " largest of " +
            std::to_string(surfaces.size()) + " nodes";
  }
  return html + ". Every patch is in patches.csv.</p>";
}

std::string SensorTable(const RunRecord& record, const UnitNames& units) {
  if (record.sensors.empty()) return "";
  const std::string unit = std::string(" [") + units.irradiance + "]";
  std::string html =
      "<h2>Sensors</h2><table>" + Head({"Grid", "#Sensors", "#Mean" + unit, "#Least" + unit,
                                        "#Most" + unit, "#U0 = least / mean", "#Inside solids"});
  for (const SensorGrid& grid : record.sensors) {
    const GridFigures figures = FiguresOf(grid);
    html += "<tr>" + Cell(grid.name) + NumberCell(std::to_string(figures.sensors)) +
            NumberCell(Quantity(figures.mean_lx)) + NumberCell(Quantity(figures.min_lx)) +
            NumberCell(Quantity(figures.max_lx)) + NumberCell(RoundedText(figures.uniformity, 2)) +
            NumberCell(std::to_string(figures.inside)) + "</tr>";
  }
  return html + "</table>";
}

std::string Balance(const RunRecord& record, const UnitNames& units) {
  const Ledger& ledger = record.snapshot.solution->ledger;
  const double emitted = Luminance(ledger.emitted);
  const std::string unit = std::string(" [") + units.flux + "]";
  std::string html = "<h2>Balance of flux</h2><div class=\"scroll\"><table>" +
                     Head({"Flux", "#Red" + unit, "#Green" + unit, "#Blue" + unit, "#Share"});
  const std::pair<const char*, Rgb> rows[] = {{"Emitted", ledger.emitted},
                                              {"Absorbed", ledger.absorbed},
                                              {"Left the scene", ledger.escaped},
                                              {"Unsent", ledger.unsent},
                                              {"Residual", ledger.residual}};
  for (const auto& [name, flux] : rows) {
    html += "<tr>" + Cell(name);
    for (int channel = 0; channel < 3; ++channel) {
      html += NumberCell(RoundedText(flux[channel], 4));
    }
    html += NumberCell(emitted > 0 ? Percent(Luminance(flux) / emitted) : "") + "</tr>";
  }
  return html +
         "</table></div><p class=\"note\">Emitted is the sum of the others. The residual is what "
         "rounding and roulette left over; its mean is zero.</p>";
}

std::string PlanTable(const Plan& plan) {
  std::string html =
      "<h2>Plan</h2><div class=\"scroll\"><table>" + Head({"Item", "Part", "", "Reason", "Saving"});
  for (const PlanItem& item : plan.items) {
    html += "<tr>" + Cell(item.item) + Cell(item.part) + Cell(item.left_out ? "left out" : "done") +
            Cell(item.reason) + Cell(item.saving) + "</tr>";
  }
  return html + "</table></div>";
}

std::string Warnings(const PatchSet& patches) {
  if (patches.warnings.empty()) return "";
  std::string html = "<h2>Warnings</h2>";
  for (const Warning& warning : patches.warnings) {
    html += "<div class=\"warning\">" + EscapeHtml(warning.message) + " <code class=\"soft\">" +
            EscapeHtml(warning.reason) + "</code></div>";
  }
  return html;
}

std::string Unhit(const RunRecord& record) {
  constexpr size_t kShown = 40;
  const std::vector<PatchIndex> unhit = NeverHit(record);
  if (unhit.empty()) return "";
  std::string numbers;
  for (size_t k = 0; k < std::min(kShown, unhit.size()); ++k) {
    numbers += (k > 0 ? ", " : "") + std::to_string(unhit[k]);
  }
  if (unhit.size() > kShown) numbers += ", ...";
  return "<h2>Patches that no ray has hit</h2><p>" + std::to_string(unhit.size()) + " of " +
         std::to_string(record.patches->size()) +
         ": they show their emission only, and their standard error is what one ray more would "
         "bring.</p><p class=\"soft\">" +
         numbers + "</p>";
}

std::string Facts(const RunRecord& record) {
  const SolveOptions& options = record.plan.options;
  std::string html = "<h2>Run</h2><table>";
  auto fact = [&](const std::string& name, const std::string& value) {
    if (value.empty()) return;
    html += "<tr><td class=\"fact\">" + EscapeHtml(name) + "</td><td>" + EscapeHtml(value) +
            "</td></tr>";
  };
  fact("Method", MethodName(options.shoot.method));
  fact("Seed", std::to_string(options.seed));
  fact("Passes", std::to_string(record.snapshot.progress.pass));
  fact("Ended by", record.interrupted ? "interrupted" : StopReasonName(record.stop_reason));
  if (record.workers > 0) fact("Workers", std::to_string(record.workers));
  if (record.threads > 0) fact("Threads a worker", std::to_string(record.threads));
  if (record.patch_options.max_edge_m > 0) {
    fact("Longest edge", RoundedText(record.patch_options.max_edge_m, 4) + " m");
  }
  fact("Scene", record.scene_digest);
  fact("Pins", record.unit_version);
  for (const auto& [what, version] : record.versions) fact(what, version);
  for (const auto& [what, seconds] : record.timings_s) {
    fact(what, RoundedText(seconds, 3) + " s");
  }
  return html + "</table>";
}

}  // namespace

std::string EncodeReport(const RunRecord& record, const ReportPictures& pictures) {
  const UnitNames units = UnitNamesOf(record.patch_options.emission_unit);
  const std::string title = EscapeHtml(record.name);
  return "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
         "<title>" +
         title + " - Lambert</title><style>" + kReportStyle + "</style></head><body>" + "<h1>" +
         title + "</h1><p class=\"soft\">Radiosity solution by Lambert</p>" + Tiles(record, units) +
         Pictures(pictures, units) + ErrorChart(record) + ReferenceTable(record) +
         SensorTable(record, units) + SurfaceTable(record, units) + Balance(record, units) +
         PlanTable(record.plan) + Warnings(*record.patches) + Unhit(record) + Facts(record) +
         "</body></html>\n";
}

}  // namespace lambert
