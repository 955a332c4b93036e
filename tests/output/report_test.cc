#include "radiosity/output/report.h"

#include <gtest/gtest.h>

#include "radiosity/output/chart.h"
#include "tests/output/known_light.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

RunRecord SomeRecord() {
  RunRecord record = RecordOf(PatchesOf(MakeCornell()), [](Vec3) { return Rgb{1, 1, 1}; });
  for (int pass = 1; pass <= 3; ++pass) {
    ConvergenceRow row;
    row.progress.pass = pass;
    row.progress.seconds = pass;
    row.progress.estimated_rms_area = pass == 1 ? -1 : 0.1 / pass;
    record.convergence.push_back(row);
  }
  return record;
}

std::string ReportOf(const RunRecord& record) {
  ReportPictures pictures;
  pictures.png = "PNG";
  pictures.false_color_png = "FALSE";
  pictures.scale = {1, 10, {1, 2, 5, 10}};
  pictures.view.origin = "the scene's camera";
  return EncodeReport(record, pictures);
}

bool Has(const std::string& page, const std::string& text) {
  return page.find(text) != std::string::npos;
}

TEST(EncodeReport, NeedsNoNetworkAndNoScript) {
  const std::string page = ReportOf(SomeRecord());
  for (const char* bad : {"http:", "https:", "<script", "<link", "@import", "url("}) {
    EXPECT_FALSE(Has(page, bad)) << bad;
  }
  EXPECT_TRUE(Has(page, "src=\"data:image/png;base64,UE5H\""));
}

TEST(EncodeReport, ShowsPicturesChartSurfacesBalancePlanAndFacts) {
  RunRecord record = SomeRecord();
  const std::string page = ReportOf(record);
  for (const char* part : {"Irradiance", "Error against time", "<polyline", "Surfaces",
                           "Balance of flux", "Plan", "pins-1", "123\u202f456"}) {
    EXPECT_TRUE(Has(page, part)) << part;
  }
  EXPECT_TRUE(Has(page, EscapeHtml(record.plan.items[0].reason)));
  EXPECT_FALSE(Has(page, "Against the reference"));
  record.measures = ErrorMeasures{0.125, 0.2, std::nullopt, 0.3, 0.4};
  EXPECT_TRUE(Has(ReportOf(record), "12.5\u2009%"));
}

TEST(EncodeReport, HasATableOfSensors) {
  RunRecord record = SomeRecord();
  EXPECT_FALSE(Has(ReportOf(record), "Sensors"));
  const auto gray = [](double lx) { return Rgb{lx, lx, lx}; };
  record.sensors.push_back({"desk <1>",
                            std::vector<Vec3>(4),
                            std::vector<Vec3>(4, {0, 1, 0}),
                            {false, false, false, true},
                            {gray(120), gray(230), gray(340), gray(9)},
                            std::vector<Rgb>(4)});
  const std::string page = ReportOf(record);
  const size_t begin = page.find("<h2>Sensors</h2>");
  ASSERT_NE(begin, std::string::npos);
  const std::string table = page.substr(begin, page.find("</table>", begin) - begin);
  // Four sensors, mean 230, least 120, most 340, U0 = 120 / 230; one is inside a solid.
  for (const char* cell : {"desk &lt;1&gt;", ">4<", ">230<", ">120<", ">340<", ">0.52<", ">1<"}) {
    EXPECT_TRUE(Has(table, cell)) << cell << " in " << table;
  }
}

TEST(EncodeReport, TellsWarnings) {
  RunRecord record = SomeRecord();
  PatchSet patches = *record.patches;
  patches.warnings.push_back({"NO_EMITTERS", "nothing in the scene emits light"});
  record.patches = std::make_shared<const PatchSet>(patches);
  EXPECT_TRUE(Has(ReportOf(record), "nothing in the scene emits light"));
}

TEST(EncodeReport, ListsPatchesThatNoRayHasHit) {
  RunRecord record = SomeRecord();
  Solution solution = *record.snapshot.solution;
  const auto report = [&](int64_t hits) {
    solution.hits.assign(record.patches->size(), 5);
    solution.hits[11] = hits;
    record.snapshot.solution = std::make_shared<const Solution>(solution);
    return ReportOf(record);
  };
  EXPECT_FALSE(Has(report(5), "no ray has hit"));
  EXPECT_TRUE(Has(report(0), "1 of 32: they show"));
  EXPECT_TRUE(Has(report(0), "<p class=\"soft\">11</p>"));
}

TEST(EncodeReport, NamesFromFilesCannotBecomeMarkup) {
  RunRecord record = SomeRecord();
  record.name = "<script>alert(1)</script>";
  PatchSet patches = *record.patches;
  patches.node_names[0] = "<img src=x>";
  record.patches = std::make_shared<const PatchSet>(patches);
  const std::string page = ReportOf(record);
  EXPECT_FALSE(Has(page, "<script"));
  EXPECT_FALSE(Has(page, "<img src=x>"));
}

}  // namespace
}  // namespace lambert
