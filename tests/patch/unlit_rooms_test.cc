#include "radiosity/patch/unlit_rooms.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/scenes.h"

namespace lambert {
namespace {

const Paint kGray{{0.5, 0.5, 0.5}, {}}, kLamp{{0.5, 0.5, 0.5}, {1, 1, 1}};
const Paint kTwoSided{{0.5, 0.5, 0.5}, {}, true};
constexpr Vec3 kHigh{1, 1, 1};

// The nodes of fronts, or of backs, that are unlit, once each.
std::vector<int32_t> UnlitNodes(const PatchSet& patches, bool backs = false) {
  const std::vector<bool> unlit = FindUnlitWalls(patches);
  std::vector<int32_t> nodes;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    if (unlit[i] && (patches.is_back[i] != 0) == backs) nodes.push_back(patches.source[i].node);
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

TEST(FindUnlitWalls, ADarkRoomBesideALitOneIsUnlit) {
  const PatchSet patches = PatchesOf(SceneMaker()
                                         .Box({}, kHigh, true, {kLamp}, 2)
                                         .Box({1, 0, 0}, {2, 1, 1}, true, {kGray}, 3)
                                         .Make());
  EXPECT_EQ(UnlitNodes(patches), (std::vector<int32_t>{1}));
  const std::vector<bool> unlit = FindUnlitWalls(patches);
  EXPECT_EQ(std::count(unlit.begin(), unlit.end(), true), 6 * 9 * 2);
}

TEST(FindUnlitWalls, LightInsideReachesAllWalls) {
  const auto room = [] { return SceneMaker().Box({}, kHigh, true, {kGray}, 2); };
  const Vec3 u{0.1, 0, 0}, v{0, 0.1, 0};
  EXPECT_EQ(UnlitNodes(PatchesOf(room().Light({0.5, 0.5, 0.5}, {1, 1, 1}).Make())).size(), 0u);
  EXPECT_EQ(UnlitNodes(PatchesOf(room().Light({0.5, 0.5, 1.5}, {1, 1, 1}).Make())).size(), 1u);
  EXPECT_EQ(UnlitNodes(PatchesOf(room().Quad({0.5, 0.5, 0.5}, u, v, kLamp).Make())).size(), 0u);
  EXPECT_EQ(UnlitNodes(PatchesOf(room().Quad({0.5, 0.5, 1.5}, u, v, kLamp).Make())).size(), 1u);
  // Through the wall.
  EXPECT_EQ(UnlitNodes(PatchesOf(room().Quad({0.5, 0.5, 0.5}, u, {0, 9, 0}, kLamp).Make())).size(),
            0u);
}

TEST(FindUnlitWalls, OneWallThatEmitsIsEnough) {
  std::vector<Rgb> ceiling(6);
  ceiling[3] = {0, 0, 1};
  EXPECT_EQ(UnlitNodes(PatchesOf(MakeBox(1, {0.5, 0.5, 0.5}, ceiling))).size(), 0u);
}

TEST(FindUnlitWalls, TheInsideOfATwoSidedBoxIsARoom) {
  const PatchSet patches = PatchesOf(SceneMaker()
                                         .Box({}, {3, 3, 3}, true, {kLamp})
                                         .Box({1, 0, 1}, {2, 1, 2}, false, {kTwoSided}, 2)
                                         .Make());
  EXPECT_EQ(UnlitNodes(patches, /*backs=*/true), (std::vector<int32_t>{1}));
  EXPECT_EQ(UnlitNodes(patches).size(), 0u);
}

TEST(FindUnlitWalls, WhatIsOpenOrLooksOutwardIsNoRoom) {
  PatchSet open = PatchesOf(SceneMaker().Box({}, kHigh, true, {kGray}, 2).Make());
  open.corners[5][1] = open.corners[5][1] + Vec3{1e-9, 0, 0};  // a slit
  EXPECT_EQ(UnlitNodes(open).size(), 0u);
  EXPECT_EQ(UnlitNodes(PatchesOf(SceneMaker().Box({}, kHigh, false, {kGray}).Make())).size(), 0u);
  EXPECT_EQ(UnlitNodes(PatchesOf(MakeParallelSquares(0.5, 0.5))).size(), 0u);
}

// A node of a large dark room and a block outside of it: the block is not in the room.
TEST(FindUnlitWalls, ShellsOfOneNodeAreToldApart) {
  PatchSet patches = PatchesOf(SceneMaker()
                                   .Box({}, {2, 2, 2}, true, {kGray})
                                   .Box({5, 0, 0}, {6, 1, 1}, false, {kGray})
                                   .Light({4, 0.5, 0.5}, {1, 1, 1})
                                   .Make());
  const std::vector<bool> expected = FindUnlitWalls(patches);
  EXPECT_EQ(std::count(expected.begin(), expected.end(), true), 12);
  for (PatchSource& source : patches.source) source.node = 0;
  EXPECT_EQ(FindUnlitWalls(patches), expected);
}

}  // namespace
}  // namespace lambert
