#include "radiosity/output/exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>

#include <exception>
#include <numbers>
#include <utility>
#include <vector>

#include "radiosity/output/float_value.h"

namespace lambert {
namespace {

// Lets OpenEXR write into memory; it goes back to fill in its table of offsets.
class MemoryStream : public Imf::OStream {
 public:
  MemoryStream() : Imf::OStream("memory") {}
  void write(const char data[], int size) override {
    const size_t count = static_cast<size_t>(size);
    if (bytes_.size() < place_ + count) bytes_.resize(place_ + count);
    bytes_.replace(place_, count, data, count);
    place_ += count;
  }
  uint64_t tellp() override { return place_; }
  void seekp(uint64_t place) override { place_ = place; }
  std::string TakeBytes() { return std::move(bytes_); }

 private:
  std::string bytes_;
  size_t place_ = 0;
};

struct Layer {
  std::string name;
  std::vector<float> values;
};

void AddRgb(const std::string& prefix, const std::vector<Rgb>& values, double factor,
            std::vector<Layer>& layers) {
  const char* names[] = {"R", "G", "B"};
  for (int channel = 0; channel < 3; ++channel) {
    Layer layer{prefix + names[channel], {}};
    layer.values.reserve(values.size());
    for (const Rgb& value : values) layer.values.push_back(FloatValue(value[channel] * factor));
    layers.push_back(std::move(layer));
  }
}

std::vector<Layer> MakeLayers(const Picture& picture) {
  std::vector<Layer> layers;
  AddRgb("", picture.radiosity_lm_per_m2, std::numbers::inv_pi, layers);
  AddRgb("irradiance.", picture.irradiance_lx, 1, layers);
  AddRgb("std_error.", picture.std_error_lm_per_m2, std::numbers::inv_pi, layers);
  layers.push_back({"id.patch", {picture.patch.begin(), picture.patch.end()}});
  return layers;
}

// One part of these channels, rows from top to bottom.
absl::StatusOr<std::string> EncodeLayers(int width, int height, std::vector<Layer> layers) {
  try {
    Imf::Header header(width, height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer frame;
    for (Layer& layer : layers) {
      header.channels().insert(layer.name, Imf::Channel(Imf::FLOAT));
      frame.insert(layer.name,
                   Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(layer.values.data()),
                              sizeof(float), sizeof(float) * static_cast<size_t>(width)));
    }
    MemoryStream stream;
    {
      constexpr int kThreads = 0;  // in the calling thread
      Imf::OutputFile file(stream, header, kThreads);
      file.setFrameBuffer(frame);
      file.writePixels(height);
    }
    return stream.TakeBytes();
  } catch (const std::exception& exception) {
    return absl::InternalError(std::string("OpenEXR: ") + exception.what());
  }
}

}  // namespace

absl::StatusOr<std::string> EncodeExr(const Picture& picture) {
  return EncodeLayers(picture.width, picture.height, MakeLayers(picture));
}

absl::StatusOr<std::string> EncodeIrradianceExr(const TexelPage& page,
                                                const TexelValues& irradiance_lx) {
  std::vector<Layer> layers = {{"R", {}}, {"G", {}}, {"B", {}}, {"valid", {}}};
  for (size_t i = 0; i < irradiance_lx.size(); ++i) {
    for (int channel = 0; channel < 3; ++channel) {
      layers[channel].values.push_back(irradiance_lx[i][channel]);
    }
    layers[3].values.push_back(page.texels[i].patch == kNoPatch ? 0.0f : 1.0f);
  }
  return EncodeLayers(page.width, page.height, std::move(layers));
}

}  // namespace lambert
