#include "radiosity/core/digest.h"

#include <gtest/gtest.h>

namespace lambert {
namespace {

TEST(Sha256, EqualsThePublishedAnswers) {  // FIPS 180-4 examples
  EXPECT_EQ(Sha256Hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(Sha256Hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(Sha256Hex("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(Sha256Hex(std::string(1000000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, ReadsBytesAfterAZero) {
  EXPECT_NE(Sha256Hex(std::string("a\0b", 3)), Sha256Hex(std::string("a\0c", 3)));
  EXPECT_EQ(Sha256Hex("abc", 2), Sha256Hex("ab"));
}

TEST(Sha256, OnlySixtyFourLowerCaseHexDigitsAreAName) {
  const std::string digest = Sha256Hex("abc");
  EXPECT_TRUE(IsSha256Hex(digest));
  EXPECT_FALSE(IsSha256Hex(""));
  EXPECT_FALSE(IsSha256Hex(digest.substr(1)));
  EXPECT_FALSE(IsSha256Hex(digest + "0"));
  for (char bad : {'A', 'F', 'g', '/', ':', '`', '.', '\0'}) {
    std::string name = digest;
    name[17] = bad;
    EXPECT_FALSE(IsSha256Hex(name)) << bad;
  }
}

}  // namespace
}  // namespace lambert
