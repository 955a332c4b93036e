#include "radiosity/core/bytes.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace lambert {
namespace {

TEST(ByteReader, ReadsBackWhatWasWritten) {
  const std::vector<double> values = {1.5, -0.0, 1e300};
  ByteWriter writer;
  writer.Put(uint32_t{7});
  writer.PutArray(values.data(), values.size());
  writer.PutArray<int>(nullptr, 0);
  writer.Put(int8_t{-3});
  const std::string bytes = writer.Take();
  ASSERT_EQ(bytes.size(), 4u + 24u + 1u);

  ByteReader reader(bytes);
  uint32_t first = 0;
  std::vector<double> read(3);
  int8_t last = 0;
  EXPECT_TRUE(reader.Get(&first));
  EXPECT_TRUE(reader.GetArray(read.data(), 3));
  EXPECT_EQ(reader.remaining(), 1u);
  EXPECT_FALSE(reader.Complete());
  EXPECT_TRUE(reader.Get(&last));
  EXPECT_EQ(first, 7u);
  EXPECT_EQ(read, values);
  EXPECT_EQ(last, -3);
  EXPECT_TRUE(reader.Complete());
}

TEST(ByteWriter, IsLittleEndian) {
  ByteWriter writer;
  writer.Put(uint32_t{0x04030201});
  EXPECT_EQ(writer.Take(), "\x01\x02\x03\x04");
}

TEST(ByteReader, NeverReadsPastTheEnd) {
  for (size_t size = 0; size <= 24; ++size) {
    const std::string bytes(size, 'x');
    for (size_t count = 0; count <= 4; ++count) {
      ByteReader reader(bytes);
      uint64_t values[4] = {1, 2, 3, 4};
      EXPECT_EQ(reader.GetArray(values, count), count * 8 <= size) << size << " " << count;
      if (count * 8 > size) {
        EXPECT_EQ(values[0], 1u) << "a failed read wrote something";
      }
    }
  }
}

TEST(ByteReader, RefusesCountsThatOverflow) {
  const std::string bytes(16, 'x');
  ByteReader reader(bytes);
  uint64_t value = 5;
  // 2^61 values of 8 bytes are 0 bytes modulo 2^64.
  EXPECT_FALSE(reader.GetArray(&value, size_t{1} << 61));
  EXPECT_FALSE(reader.GetArray(&value, std::numeric_limits<size_t>::max()));
  EXPECT_EQ(value, 5u);
}

TEST(ByteReader, EveryReadAfterAFailedOneFails) {
  const std::string bytes(6, 'x');
  ByteReader reader(bytes);
  uint64_t wide = 0;
  uint8_t narrow = 0;
  EXPECT_FALSE(reader.Get(&wide));
  EXPECT_FALSE(reader.Get(&narrow));
  EXPECT_FALSE(reader.Complete());
}

}  // namespace
}  // namespace lambert
