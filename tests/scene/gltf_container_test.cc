#include "radiosity/scene/gltf_container.h"

#include <gtest/gtest.h>

#include "tests/scene/gltf_document.h"

namespace lambert {
namespace {

TEST(FindJsonText, IsTheWholeGltfOrTheFirstChunkOfAGlb) {
  EXPECT_EQ(*FindJsonText("{\"asset\":{}}"), "{\"asset\":{}}");
  const GltfDocument document;
  const std::string glb = document.Glb();
  EXPECT_TRUE(IsGlb(glb));
  EXPECT_EQ(nlohmann::json::parse(std::string(*FindJsonText(glb))), document.json);
}

TEST(FindJsonText, RefusesGlbsWhoseLengthsLie) {
  const std::string glb = GltfDocument().Glb();
  EXPECT_TRUE(FindJsonText(glb + "trailing").ok());
  for (size_t size : {size_t{4}, size_t{12}, size_t{19}, size_t{20}, glb.size() / 2}) {
    EXPECT_FALSE(FindJsonText(glb.substr(0, size)).ok()) << size;
  }
  for (int byte : {4, 11, 15, 16}) {  // version, length, length of JSON, type of chunk
    std::string bad = glb;
    bad[byte] = '\x7f';
    EXPECT_FALSE(FindJsonText(bad).ok()) << byte;
  }
}

TEST(FindJsonText, RefusesNestingThatWouldOverflowAStack) {
  const std::string open(200'000, '['), close(200'000, ']');
  EXPECT_FALSE(FindJsonText("{\"extras\":" + open + close + "}").ok());
  EXPECT_TRUE(FindJsonText("{\"extras\":\"" + open + "\"}").ok());
  EXPECT_TRUE(FindJsonText("{\"extras\":\"\\\"" + open + "\"}").ok());
}

TEST(DecodeUri, DecodesOnlyWholeEscapes) {
  EXPECT_EQ(DecodeUri("a%20b%2Bc+d%zz%4"), "a b+c+d%zz%4");
}

TEST(IsSafeRelativeUri, KeepsToTheFolderOfTheScene) {
  for (const char* safe : {"a.bin", "textures/wood%20floor.png", "a..b.bin", "./a.bin"}) {
    EXPECT_TRUE(IsSafeRelativeUri(safe)) << safe;
  }
  for (const char* unsafe : {"", "/etc/passwd", "../a.bin", "a/../../b", "%2e%2e/a", "file:///a",
                             "http://host/a", "C:\\a", "..%5ca", "a\nb", "a%00b"}) {
    EXPECT_FALSE(IsSafeRelativeUri(unsafe)) << unsafe;
  }
}

TEST(Printable, IsOneShortLineOfAscii) {
  EXPECT_EQ(Printable("a\nb\xff"), "a b?");
  EXPECT_EQ(Printable(std::string("a\0b", 3)), "a?b");
  EXPECT_LT(Printable(std::string(100'000, 'x')).size(), 300u);
}

}  // namespace
}  // namespace lambert
