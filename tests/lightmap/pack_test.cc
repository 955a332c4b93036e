#include "radiosity/lightmap/pack.h"

#include <gtest/gtest.h>

namespace lambert {
namespace {

bool Meet(const PackedRectangle& a, const PackedRectangle& b) {
  return a.page == b.page && a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height &&
         b.y < a.y + a.height;
}

void ExpectApart(const std::vector<PackedRectangle>& rectangles,
                 const std::vector<PageSize>& pages) {
  for (size_t i = 0; i < rectangles.size(); ++i) {
    const PackedRectangle& r = rectangles[i];
    EXPECT_GE(std::min(r.x, r.y), 0);
    EXPECT_LE(r.x + r.width, pages[r.page].width);
    EXPECT_LE(r.y + r.height, pages[r.page].height);
    for (size_t j = 0; j < i; ++j) EXPECT_FALSE(Meet(r, rectangles[j])) << i << " " << j;
  }
}

TEST(PackRectangles, FewTakeTheSmallestPage) {
  std::vector<PackedRectangle> rectangles = {{20, 5}, {20, 5}, {7, 30}};
  const std::vector<PageSize> pages = PackRectangles(rectangles);
  ASSERT_EQ(pages.size(), 1u);
  EXPECT_EQ(pages[0].width, 32);
  EXPECT_EQ(pages[0].height, 30);
  ExpectApart(rectangles, pages);
}

TEST(PackRectangles, ManyFillPagesOfAtMostTheLargestSize) {
  std::vector<PackedRectangle> rectangles;
  for (int i = 0; i < 40; ++i) rectangles.push_back({90 - i, 50 + i});
  constexpr int kSide = 512;
  const std::vector<PageSize> pages = PackRectangles(rectangles, kSide);
  ASSERT_EQ(pages.size(), 2u);
  ExpectApart(rectangles, pages);
  for (const PageSize& page : pages) {
    EXPECT_LE(page.width, kSide);
    EXPECT_LE(page.height, kSide);
  }
}

TEST(PackRectangles, WhatDoesNotFitIsSaid) {
  std::vector<PackedRectangle> long_one = {{kLargestPage + 1, 1}};
  EXPECT_TRUE(PackRectangles(long_one).empty());
  std::vector<PackedRectangle> many(8, {3000, 3000});
  EXPECT_TRUE(PackRectangles(many).empty());
}

}  // namespace
}  // namespace lambert
