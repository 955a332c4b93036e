#include "radiosity/output/patch_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "radiosity/core/error.h"
#include "radiosity/output/output_file.h"
#include "tests/output/known_light.h"
#include "tests/support/read_file.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

PatchTable SomeTable() {
  const PatchSet patches = PatchesOf(MakeCornell());
  return MakePatchTable(patches, LitBy(patches, [](Vec3 p) {
                          return Rgb{1 / 3.0 + p.x, std::sqrt(2.0), 1e-300};
                        }));
}

TEST(PatchTable, ReadsBackToTheSameBits) {
  const std::string path = TestFolder() + "/patches.csv";
  PatchTable table = SomeTable();
  table.radiosity_lm_per_m2[0] = {1e30, 0.1, std::numeric_limits<double>::denorm_min()};
  ASSERT_TRUE(WritePatchTable(path, table).ok());
  const absl::StatusOr<PatchTable> back = ReadPatchTable(path);
  ASSERT_TRUE(back.ok()) << back.status();
  EXPECT_EQ(back->source, table.source);
  EXPECT_EQ(back->area_m2, table.area_m2);
  EXPECT_EQ(back->corners, table.corners);
  EXPECT_EQ(back->reflectance, table.reflectance);
  EXPECT_EQ(back->exitance_lm_per_m2, table.exitance_lm_per_m2);
  EXPECT_EQ(back->radiosity_lm_per_m2, table.radiosity_lm_per_m2);
  EXPECT_EQ(back->irradiance_lx, table.irradiance_lx);
  EXPECT_EQ(back->std_error_lm_per_m2, table.std_error_lm_per_m2);
}

TEST(PatchTable, BeginsWithTheAgreedColumnsAndCountsPatches) {
  const std::string path = TestFolder() + "/patches.csv";
  ASSERT_TRUE(WritePatchTable(path, SomeTable()).ok());
  const std::string text = ReadFile(path);
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "patch,node,mesh,primitive,triangle,area_m2,x0,y0,z0,x1,y1,z1,x2,y2,z2,"
            "reflectance_r,reflectance_g,reflectance_b,exitance_r,exitance_g,exitance_b,"
            "radiosity_r,radiosity_g,radiosity_b,irradiance_r,irradiance_g,irradiance_b,"
            "std_error_r,std_error_g,std_error_b");
  EXPECT_EQ(text.substr(text.find('\n') + 1, 2), "0,");
  EXPECT_EQ(text.back(), '\n');
}

TEST(PatchTable, HoldsWorldCoordinates) {
  PatchSet patches = PatchesOf(MakeFurnace(0.5));
  patches.origin = {1000, 0, 0};
  const PatchTable table = MakePatchTable(patches, LitBy(patches, [](Vec3) { return Rgb{}; }));
  EXPECT_EQ(table.corners[3][1], patches.corners[3][1] + patches.origin);
}

TEST(PatchTable, ColumnsMayStandInAnyOrder) {
  const std::string path = TestFolder() + "/patches.csv";
  ASSERT_TRUE(WritePatchTable(path, SomeTable()).ok());
  // Every line turned about: the last column first, and a column of another program added.
  std::string turned;
  const std::string text = ReadFile(path);
  for (size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos;
       begin = end + 1) {
    const std::string line = text.substr(begin, end - begin);
    const size_t last = line.rfind(',');
    turned += line.substr(last + 1) + "," + line.substr(0, last) + ",note\r\n";
  }
  ASSERT_TRUE(WriteOutputFile(path, turned).ok());
  const absl::StatusOr<PatchTable> back = ReadPatchTable(path);
  ASSERT_TRUE(back.ok()) << back.status();
  EXPECT_EQ(back->std_error_lm_per_m2, SomeTable().std_error_lm_per_m2);
}

TEST(PatchTable, AMissingFileIsNotFound) {
  EXPECT_EQ(ReadPatchTable(TestFolder() + "/none.csv").status().code(),
            absl::StatusCode::kNotFound);
}

TEST(PatchTable, BadLinesAreNamed) {
  const std::string path = TestFolder() + "/patches.csv";
  ASSERT_TRUE(WriteOutputFile(path, "patch,node\n0,1\n").ok());
  EXPECT_EQ(GetErrorDetail(ReadPatchTable(path).status())->message, "column 'mesh' is missing");
  ASSERT_TRUE(WritePatchTable(path, SomeTable()).ok());
  for (const char* bad : {"", "x", "nan", "inf", "1e999", "1 "}) {
    std::string text = ReadFile(path);
    text.replace(text.rfind(',') + 1, std::string::npos, bad);
    const std::string broken = TestFolder() + "/broken.csv";
    ASSERT_TRUE(WriteOutputFile(broken, text).ok());
    ASSERT_TRUE(WritePatchTable(path, SomeTable()).ok());
    const absl::StatusOr<PatchTable> table = ReadPatchTable(broken);
    ASSERT_FALSE(table.ok()) << bad;
    EXPECT_EQ(GetErrorDetail(table.status())->message, "no number in column 'std_error_b'");
  }
}

}  // namespace
}  // namespace lambert
