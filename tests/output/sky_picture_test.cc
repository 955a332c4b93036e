#include "radiosity/output/sky_picture.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "radiosity/core/error.h"
#include "tests/output/known_light.h"

namespace lambert {
namespace {

// An EXR file of 4 x 2 pixels whose channel number c is c + 10 * pixel, but -1 in the last pixel.
std::string PictureOf(const std::string& channels) {
  constexpr int kWidth = 4, kHeight = 2;
  const std::string path = TestFolder() + "/sky.exr";
  Imf::Header header(kWidth, kHeight);
  Imf::FrameBuffer frame;
  std::vector<std::vector<float>> values(channels.size(), std::vector<float>(kWidth * kHeight));
  for (size_t c = 0; c < channels.size(); ++c) {
    for (int k = 0; k < kWidth * kHeight; ++k) values[c][k] = static_cast<float>(c) + 10.0f * k;
    values[c].back() = -1;
    const std::string name(1, channels[c]);
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    frame.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values[c].data()),
                                  sizeof(float), sizeof(float) * kWidth));
  }
  {
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(frame);
    file.writePixels(kHeight);
  }
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(DecodeSkyPicture, ReadsRowsFromTheTopAndTakesNoNegativeLight) {
  const absl::StatusOr<SkyMap> sky = DecodeSkyPicture("sky.exr", PictureOf("RGB"));
  ASSERT_TRUE(sky.ok()) << sky.status();
  EXPECT_EQ(sky->width, 4);
  EXPECT_EQ(sky->height, 2);
  std::vector<float> expected;
  for (int k = 0; k < 7; ++k) {
    for (int c = 0; c < 3; ++c) expected.push_back(static_cast<float>(c + 10 * k));
  }
  expected.insert(expected.end(), 3, 0.0f);
  EXPECT_EQ(sky->rgb, expected);
}

TEST(DecodeSkyPicture, NamesWhatIsNoPictureOfASky) {
  for (const std::string& bytes :
       {std::string("no picture"), PictureOf("RG"), PictureOf("RGB").substr(0, 300)}) {
    const absl::StatusOr<SkyMap> sky = DecodeSkyPicture("sky.exr", bytes);
    ASSERT_FALSE(sky.ok());
    EXPECT_EQ(ReasonOf(sky.status()), "SCENE_INVALID");
    EXPECT_NE(sky.status().message().find("sky.exr"), std::string::npos) << sky.status();
  }
}

}  // namespace
}  // namespace lambert
