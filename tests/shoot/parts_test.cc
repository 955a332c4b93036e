#include "radiosity/shoot/parts.h"

#include <gtest/gtest.h>

#include <set>

namespace lambert {
namespace {

TEST(Parts, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (Part part : AllParts()) EXPECT_TRUE(names.insert(PartName(part)).second) << PartName(part);
  EXPECT_EQ(names.count("std-error"), 1u);
}

TEST(PartSet, ReadsWhatItWritesInAnyOrderByCommasOrPlusSigns) {
  PartSet parts;
  EXPECT_EQ(parts.Text(), "none");
  ASSERT_TRUE(parts.Read("ambient+color,black"));
  EXPECT_EQ(parts.Text(), "color,black,ambient");
  for (Part part : AllParts()) {
    const bool read = part == Part::kColor || part == Part::kBlack || part == Part::kAmbient;
    EXPECT_EQ(parts.Has(part), read) << PartName(part);
  }
  PartSet again;
  again.Add(Part::kAmbient);
  again.Add(Part::kBlack);
  EXPECT_EQ((parts & again).Text(), "black,ambient");
  EXPECT_NE(again, parts);
  ASSERT_TRUE(parts.Read("none"));
  EXPECT_EQ(parts, PartSet());
}

TEST(PartSet, RefusesWhatIsNoPartAndKeepsWhatItHeld) {
  PartSet parts;
  ASSERT_TRUE(parts.Read("color"));
  for (const char* text : {"", "colour", "color,", "color;black", " color", "color,none"}) {
    EXPECT_FALSE(parts.Read(text)) << text;
    EXPECT_EQ(parts.Text(), "color");
  }
}

}  // namespace
}  // namespace lambert
