#include "radiosity/output/exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "radiosity/output/float_value.h"
#include "radiosity/output/output_file.h"
#include "tests/output/known_light.h"

namespace lambert {
namespace {

Picture SmallPicture() {
  Picture picture;
  picture.width = 3;
  picture.height = 2;
  for (int pixel = 0; pixel < 6; ++pixel) {
    const double v = pixel;
    picture.radiosity_lm_per_m2.push_back({v, 2 * v, 3 * v});
    picture.irradiance_lx.push_back({10 + v, 20 + v, 30 + v});
    picture.std_error_lm_per_m2.push_back({0.1, 0.2, 0.3});
    picture.patch.push_back(pixel == 0 ? kNoPatch : 100 + pixel);
  }
  return picture;
}

// One channel of an EXR file as OpenEXR reads it.
std::vector<float> ReadChannel(const std::string& path, const std::string& name) {
  Imf::InputFile file(path.c_str());
  const auto size = file.header().dataWindow().size();
  const int width = size.x + 1, height = size.y + 1;
  std::vector<float> values(static_cast<size_t>(width) * height, -7);
  Imf::FrameBuffer frame;
  frame.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), sizeof(float),
                                sizeof(float) * width));
  file.setFrameBuffer(frame);
  file.readPixels(0, height - 1);
  return values;
}

std::string Written(const Picture& picture) {
  const std::string path = TestFolder() + "/room.exr";
  const absl::StatusOr<std::string> bytes = EncodeExr(picture);
  EXPECT_TRUE(bytes.ok()) << bytes.status();
  EXPECT_TRUE(WriteOutputFile(path, *bytes).ok());
  return path;
}

TEST(EncodeExr, HasOnePartAndTheAgreedChannels) {
  const std::string path = Written(SmallPicture());
  Imf::InputFile file(path.c_str());
  std::vector<std::string> names;
  for (auto it = file.header().channels().begin(); it != file.header().channels().end(); ++it) {
    names.push_back(it.name());
    EXPECT_EQ(it.channel().type, Imf::FLOAT);
  }
  const std::vector<std::string> expected = {"B",
                                             "G",
                                             "R",
                                             "id.patch",
                                             "irradiance.B",
                                             "irradiance.G",
                                             "irradiance.R",
                                             "std_error.B",
                                             "std_error.G",
                                             "std_error.R"};
  EXPECT_EQ(names, expected);
}

TEST(EncodeExr, ValuesComeBackInTheirUnits) {
  const std::string path = Written(SmallPicture());
  const std::vector<float> green = ReadChannel(path, "G");
  EXPECT_FLOAT_EQ(green[5], static_cast<float>(10 / std::numbers::pi));  // cd/m2
  EXPECT_FLOAT_EQ(ReadChannel(path, "irradiance.B")[4], 34);
  EXPECT_FLOAT_EQ(ReadChannel(path, "std_error.R")[1], static_cast<float>(0.1 / std::numbers::pi));
  EXPECT_EQ(ReadChannel(path, "id.patch"), (std::vector<float>{-1, 101, 102, 103, 104, 105}));
}

TEST(EncodeExr, HoldsNeitherInfinitiesNorNans) {
  Picture picture = SmallPicture();
  picture.radiosity_lm_per_m2[1] = {1e300, std::nan(""), 1e-310};
  const std::string path = Written(picture);
  for (const char* name : {"R", "G", "B"}) {
    for (float value : ReadChannel(path, name)) EXPECT_TRUE(std::isfinite(value));
  }
}

TEST(FloatValue, StaysWithinFloat32) {
  EXPECT_EQ(FloatValue(1e300), std::numeric_limits<float>::max());
  EXPECT_EQ(FloatValue(-1e300), -std::numeric_limits<float>::max());
  EXPECT_EQ(FloatValue(std::nan("")), 0);
  EXPECT_EQ(FloatValue(0.5), 0.5f);
}

}  // namespace
}  // namespace lambert
