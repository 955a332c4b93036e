#include "radiosity/output/sky_picture.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <stdexcept>

#include "radiosity/core/error.h"

namespace lambert {
namespace {

constexpr int64_t kMostPixels = 1 << 25;

// Lets OpenEXR read from memory.
class MemoryStream : public Imf::IStream {
 public:
  explicit MemoryStream(const std::string& bytes) : Imf::IStream("memory"), bytes_(bytes) {}
  bool read(char to[], int size) override {
    const size_t count = static_cast<size_t>(std::max(size, 0));
    if (count > bytes_.size() - place_) throw std::runtime_error("it is cut off");
    std::memcpy(to, bytes_.data() + place_, count);
    place_ += count;
    return place_ < bytes_.size();
  }
  uint64_t tellg() override { return place_; }
  void seekg(uint64_t place) override { place_ = std::min<uint64_t>(place, bytes_.size()); }

 private:
  const std::string& bytes_;
  size_t place_ = 0;
};

absl::Status BadPicture(const std::string& name, const std::string& what) {
  return SceneError(name, what, "give a lat-long OpenEXR picture with the channels R, G and B");
}

}  // namespace

absl::StatusOr<SkyMap> DecodeSkyPicture(const std::string& name, const std::string& bytes) {
  try {
    MemoryStream stream(bytes);
    Imf::InputFile file(stream);
    const auto window = file.header().dataWindow();
    const int64_t width = int64_t{window.max.x} - window.min.x + 1;
    const int64_t height = int64_t{window.max.y} - window.min.y + 1;
    if (width < 1 || height < 1 || width > kMostPixels || height > kMostPixels ||
        width * height > kMostPixels) {
      return BadPicture(name, "it has too many pixels, or none");
    }
    SkyMap sky{static_cast<int>(width), static_cast<int>(height), {}};
    sky.rgb.resize(3 * static_cast<size_t>(width * height));
    Imf::FrameBuffer frame;
    const char* channels[] = {"R", "G", "B"};
    for (int c = 0; c < 3; ++c) {
      if (file.header().channels().findChannel(channels[c]) == nullptr) {
        return BadPicture(name, std::string("it has no channel ") + channels[c]);
      }
      frame.insert(channels[c],
                   Imf::Slice::Make(Imf::FLOAT, sky.rgb.data() + c, window, 3 * sizeof(float),
                                    3 * sizeof(float) * static_cast<size_t>(width)));
    }
    file.setFrameBuffer(frame);
    file.readPixels(window.min.y, window.max.y);
    for (float& luminance : sky.rgb) luminance = luminance < 0 ? 0 : luminance;
    return sky;
  } catch (const std::exception& exception) {
    return BadPicture(name, std::string("it cannot be read: ") + exception.what());
  }
}

}  // namespace lambert
