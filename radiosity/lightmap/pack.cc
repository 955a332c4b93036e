#include "radiosity/lightmap/pack.h"

#include <stb/stb_rect_pack.h>

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace lambert {
namespace {

constexpr int kSmallestPage = 16;

// Packs what fits of `waiting` onto a page; the rest is left in `waiting`.
PageSize FillPage(int side, int page, std::vector<int>& waiting,
                  std::vector<PackedRectangle>& rectangles) {
  std::vector<stbrp_node> nodes(side);
  stbrp_context context;
  stbrp_init_target(&context, side, side, nodes.data(), side);
  std::vector<stbrp_rect> rects;
  for (int i : waiting) {
    stbrp_rect rect{};
    rect.id = i;
    rect.w = rectangles[i].width;
    rect.h = rectangles[i].height;
    rects.push_back(rect);
  }
  stbrp_pack_rects(&context, rects.data(), static_cast<int>(rects.size()));
  waiting.clear();
  PageSize used{side, 0};
  for (const stbrp_rect& rect : rects) {
    if (!rect.was_packed) {
      waiting.push_back(rect.id);
      continue;
    }
    PackedRectangle& placed = rectangles[rect.id];
    placed.page = page;
    placed.x = rect.x;
    placed.y = rect.y;
    used.height = std::max(used.height, placed.y + placed.height);
  }
  return used;
}

}  // namespace

std::vector<PageSize> PackRectangles(std::vector<PackedRectangle>& rectangles, int largest) {
  int64_t area = 0;
  int longest = 0;
  for (const PackedRectangle& r : rectangles) {
    area += int64_t{1} * r.width * r.height;
    longest = std::max({longest, r.width, r.height});
  }
  if (longest > largest || area > int64_t{kMostPages} * largest * largest) return {};
  int side = kSmallestPage;
  while (side < largest && (side < longest || int64_t{1} * side * side < area)) side *= 2;
  std::vector<int> all(rectangles.size());
  std::iota(all.begin(), all.end(), 0);
  for (; side < largest; side *= 2) {
    std::vector<int> waiting = all;
    const PageSize page = FillPage(side, 0, waiting, rectangles);
    if (waiting.empty()) return {page};
  }
  std::vector<PageSize> pages;
  std::vector<int> waiting = all;
  while (!waiting.empty() && pages.size() < kMostPages) {
    pages.push_back(FillPage(side, static_cast<int>(pages.size()), waiting, rectangles));
  }
  if (!waiting.empty()) pages.clear();
  return pages;
}

}  // namespace lambert
