#include "radiosity/output/convergence.h"

#include <gtest/gtest.h>

#include "radiosity/core/error.h"
#include "tests/output/known_light.h"
#include "tests/support/read_file.h"

namespace lambert {
namespace {

ConvergenceRow SomeRow() {
  ConvergenceRow row;
  row.method = "phs";
  row.seed = 7;
  row.progress.pass = 2;
  row.progress.step = 5;
  row.progress.rays = 123456;
  row.progress.seconds = 1.5;
  row.progress.cpu_seconds = 2.75;
  row.progress.unsent_fraction = 1e-7;
  row.progress.estimated_rms_area = 0.03;
  return row;
}

TEST(Convergence, UnknownValuesStayEmpty) {
  EXPECT_EQ(FormatConvergenceRow(SomeRow()), "phs,7,2,5,123456,1.5,2.75,1e-07,0.03,,,,,,\n");
}

TEST(Convergence, MeasuresAgainstAReferenceFillTheLastColumns) {
  ConvergenceRow row = SomeRow();
  row.progress.estimated_rms_patch = 0.05;
  row.measures = {0.1, 0.2, 0.3, 0.4, -0.001};
  EXPECT_EQ(FormatConvergenceRow(row),
            "phs,7,2,5,123456,1.5,2.75,1e-07,0.03,0.05,0.1,0.2,0.3,0.4,-0.001\n");
}

TEST(ConvergenceLog, RowsAreInTheFileAsSoonAsTheyAreAppended) {
  const std::string path = TestFolder() + "/convergence.csv";
  absl::StatusOr<ConvergenceLog> log = ConvergenceLog::Create(path);
  ASSERT_TRUE(log.ok());
  EXPECT_EQ(ReadFile(path), ConvergenceHeader());
  ASSERT_TRUE(log->Append(SomeRow()).ok());
  EXPECT_EQ(ReadFile(path), ConvergenceHeader() + FormatConvergenceRow(SomeRow()));
  ConvergenceLog moved = std::move(*log);
  ASSERT_TRUE(moved.Append(SomeRow()).ok());
  EXPECT_EQ(ReadFile(path), ConvergenceHeader() + FormatConvergenceRow(SomeRow()) +
                                FormatConvergenceRow(SomeRow()));
}

TEST(ConvergenceLog, AFileThatCannotBeMadeIsNamed) {
  const std::string path = TestFolder() + "/missing/convergence.csv";
  EXPECT_EQ(GetErrorDetail(ConvergenceLog::Create(path).status())->where, path);
}

}  // namespace
}  // namespace lambert
