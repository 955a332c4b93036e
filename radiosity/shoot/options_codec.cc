#include "radiosity/shoot/options_codec.h"

#include "radiosity/core/bytes.h"
#include "radiosity/core/error.h"
#include "radiosity/shoot/settings.h"

namespace lambert {
namespace {

constexpr uint32_t kOptionsMagic = 0x324F534C;  // "LSO2"
constexpr uint32_t kMaxTexts = 1024, kMaxTextBytes = 4096;

struct Header {
  uint32_t magic = kOptionsMagic;
  uint32_t texts = 0;
};

absl::Status Corrupt() {
  return MakeError(absl::StatusCode::kDataLoss,
                   {"OPTIONS_INVALID", "shoot options", "the bytes are not shoot options",
                    "use programs of one version"});
}

}  // namespace

std::string EncodeShootOptions(const ShootOptions& options) {
  std::vector<std::string> texts = {"method", MethodName(options.method)};
  for (const auto& [name, text] : ChangedSettings(options)) {
    texts.push_back(name);
    texts.push_back(text);
  }
  for (const std::string& node : options.region) {
    texts.push_back("region");
    texts.push_back(node);
  }
  ByteWriter writer;
  writer.Put(Header{kOptionsMagic, static_cast<uint32_t>(texts.size())});
  for (const std::string& text : texts) {
    writer.Put(static_cast<uint32_t>(text.size()));
    writer.PutArray(text.data(), text.size());
  }
  return writer.Take();
}

absl::StatusOr<ShootOptions> DecodeShootOptions(const std::string& bytes) {
  ByteReader reader(bytes);
  Header header;
  if (!reader.Get(&header) || header.magic != kOptionsMagic || header.texts % 2 != 0 ||
      header.texts > kMaxTexts) {
    return Corrupt();
  }
  std::vector<std::string> texts;
  for (uint32_t k = 0; k < header.texts; ++k) {
    uint32_t size = 0;
    if (!reader.Get(&size) || size > kMaxTextBytes || size > reader.remaining()) return Corrupt();
    texts.emplace_back(size, '\0');
    reader.GetArray(texts.back().data(), size);
  }
  if (!reader.Complete()) return Corrupt();
  ShootOptions options;
  for (size_t k = 0; k < texts.size(); k += 2) {
    if (texts[k] == "region") {
      options.region.push_back(texts[k + 1]);
    } else if (texts[k] == "method") {
      absl::StatusOr<Method> method = ParseMethod(texts[k + 1]);
      if (!method.ok()) return Corrupt();
      options.method = *method;
    } else if (!ApplySetting(texts[k], texts[k + 1], options).ok()) {
      return Corrupt();
    }
  }
  if (absl::Status status = options.Validate(); !status.ok()) return status;
  if (EncodeShootOptions(options) != bytes) return Corrupt();  // "4.0" for 4, or one thing twice
  return options;
}

}  // namespace lambert
