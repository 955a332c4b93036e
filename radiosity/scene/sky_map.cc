#include "radiosity/scene/sky_map.h"

#include <cmath>
#include <cstring>
#include <numbers>

#include "absl/strings/str_cat.h"
#include "radiosity/core/error.h"

namespace lambert {
namespace {

constexpr char kMagic[] = "LMBSKY01";
constexpr size_t kHead = 16;  // magic, width, height

absl::Status BadSky(const std::string& name, const std::string& what) {
  return SceneError(name, what, "give the sky as a lat-long picture with --sky FILE.exr");
}

// Cosine of the angle to the zenith at the upper edge of a row.
double UpperEdge(int row, int height) {
  if (row == 0) return 1;
  if (row == height) return -1;
  return std::cos(std::numbers::pi * row / height);
}

std::shared_ptr<const SphereTable> HalfSky(std::vector<float> values) {
  return *SphereTable::Create({true, 1, {0, 1}, {0, 1}, std::move(values)});
}

}  // namespace

SkyMap FittingSky(SkyMap sky) {
  while (int64_t{sky.width} * sky.height > kMostSkyPixels && sky.width > 1 && sky.height > 1) {
    SkyMap half{sky.width / 2, sky.height / 2, {}};
    for (int row = 0; row < half.height; ++row) {
      const double top = UpperEdge(2 * row, sky.height),
                   middle = UpperEdge(2 * row + 1, sky.height),
                   bottom = UpperEdge(2 * row + 2, sky.height);
      const double upper = (top - middle) / (top - bottom);
      for (int k = 0; k < 3 * half.width; ++k) {
        const auto mean = [&](int of_row) {
          const size_t at = 3 * (static_cast<size_t>(of_row) * sky.width + 2 * (k / 3)) + k % 3;
          return 0.5 * (static_cast<double>(sky.rgb[at]) + sky.rgb[at + 3]);
        };
        half.rgb.push_back(
            static_cast<float>(mean(2 * row) * upper + mean(2 * row + 1) * (1 - upper)));
      }
    }
    sky = std::move(half);
  }
  return sky;
}

bool IsSkyMap(const std::string& bytes) { return bytes.compare(0, 8, kMagic) == 0; }

std::string EncodeSkyMap(const SkyMap& sky) {
  const int32_t size[2] = {sky.width, sky.height};
  std::string bytes = kMagic;
  bytes.append(reinterpret_cast<const char*>(size), sizeof size);
  bytes.append(reinterpret_cast<const char*>(sky.rgb.data()), sky.rgb.size() * sizeof(float));
  return bytes;
}

absl::StatusOr<std::shared_ptr<const SphereTable>> DecodeSkyMap(const std::string& name,
                                                                const std::string& bytes) {
  if (!IsSkyMap(bytes) || bytes.size() < kHead) return BadSky(name, "it is no sky map");
  int32_t size[2];
  std::memcpy(size, bytes.data() + 8, sizeof size);
  const int64_t width = size[0], height = size[1];
  if (width < 1 || height < 1 || width > kMostSkyPixels || height > kMostSkyPixels ||
      width * height > kMostSkyPixels) {
    return BadSky(name, absl::StrCat("it has ", width, " by ", height, " pixels, more than ",
                                     kMostSkyPixels, " or none"));
  }
  const size_t row_floats = 3 * static_cast<size_t>(width);
  if (bytes.size() != kHead + row_floats * height * sizeof(float)) {
    return BadSky(name, "its length is not what its size says");
  }
  SphereGrid grid{false, 3, {}, {}, std::vector<float>(row_floats * height)};
  for (int64_t row = height; row >= 0; --row) {
    grid.z.push_back(UpperEdge(static_cast<int>(row), static_cast<int>(height)));
  }
  for (int64_t column = 0; column <= width; ++column) {
    grid.turn.push_back(static_cast<double>(column) / static_cast<double>(width) - 0.5);
  }
  // The table begins at the nadir.
  for (int64_t row = 0; row < height; ++row) {
    std::memcpy(grid.values.data() + row_floats * (height - 1 - row),
                bytes.data() + kHead + row_floats * row * sizeof(float),
                row_floats * sizeof(float));
  }
  auto table = SphereTable::Create(std::move(grid));
  if (!table.ok()) return BadSky(name, "a luminance is negative or not finite");
  return table;
}

std::shared_ptr<const SphereTable> UniformSky() { return HalfSky({1, 1, 1, 1}); }
std::shared_ptr<const SphereTable> OvercastSky() { return HalfSky({1, 1, 3, 3}); }

}  // namespace lambert
