// PNG bytes of display pictures.
#pragma once

#include <string>
#include <vector>

#include "radiosity/core/rgb.h"

namespace lambert {

// An 8-bit sRGB PNG of `display` (0..1, linear Rec. 709, rows from top to bottom), with `alpha`
// (0..1) where there is one. Requires: display.size() == width * height > 0; no alpha, or as many.
std::string EncodePng(int width, int height, const std::vector<Rgb>& display,
                      const std::vector<float>& alpha = {});

// For writers of stb that call back: appends to the std::string `context`.
void AppendBytes(void* context, void* data, int size);

}  // namespace lambert
