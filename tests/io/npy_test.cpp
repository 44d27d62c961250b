// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/npy.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "invsim/base/error.h"
#include "npy_bytes.h"

namespace invsim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

NpyArray RoundTrip(const NpyArray& array) {
  return ParseNpy(FormatNpy(array), "a.npy");
}

TEST(Npy, NumbersSurvive) {
  const auto doubles = RoundTrip(NpyArray::Doubles({3}, {0.1, -1e300, 5e-324}));
  EXPECT_THAT(doubles.ToDoubles(""), ElementsAre(0.1, -1e300, 5e-324));
  EXPECT_EQ(doubles.item_size(), 8u);
  const auto floats = RoundTrip(NpyArray::Floats({2, 1}, {0.1, 2}));
  EXPECT_THAT(floats.ToDoubles(""), ElementsAre(0.1f, 2));
  EXPECT_THAT(floats.shape(), ElementsAre(2, 1));
  const auto ints = RoundTrip(NpyArray::Ints({2}, {-7, 2147483647}));
  EXPECT_THAT(ints.ToIntegers(""), ElementsAre(-7, 2147483647));
  const auto longs = RoundTrip(NpyArray::Longs({1}, {-9007199254740993}));
  EXPECT_THAT(longs.ToIntegers(""), ElementsAre(-9007199254740993));
  const auto uints = RoundTrip(NpyArray::Uints({1}, {4294967295u}));
  EXPECT_THAT(uints.ToIntegers(""), ElementsAre(4294967295));
  EXPECT_THAT(uints.ToDoubles(""), ElementsAre(4294967295.0));
  const auto ulongs = RoundTrip(NpyArray::Ulongs({1}, {42}));
  EXPECT_THAT(ulongs.ToIntegers(""), ElementsAre(42));
  const auto bools = RoundTrip(NpyArray::Bools({2}, {true, false}));
  EXPECT_THAT(bools.ToDoubles(""), ElementsAre(1, 0));
}

TEST(Npy, ScalarAndEmptyArraysSurvive) {
  const auto scalar = RoundTrip(NpyArray::Doubles({}, {30}));
  EXPECT_TRUE(scalar.shape().empty());
  EXPECT_THAT(scalar.ToDoubles(""), ElementsAre(30));
  const auto empty = RoundTrip(NpyArray::Doubles({0, 3}, {}));
  EXPECT_THAT(empty.shape(), ElementsAre(0, 3));
  EXPECT_EQ(empty.size(), 0u);
}

TEST(Npy, TextSurvives) {
  const std::vector<std::string> words = {
      "neutral", "", "h\u00e9 \u20ac \U0001f600"};
  EXPECT_EQ(RoundTrip(NpyArray::Text({3}, words)).ToStrings(""), words);
  const auto bytes = ParseNpy(
      NpyBytes(NpyHead("|S6", "()"), std::string("male\0\0", 6)), "a.npy");
  EXPECT_THAT(bytes.ToStrings(""), ElementsAre("male"));
}

// Bytes that are no UTF-8 (the second pair is a zero written too long) are
// taken as Latin-1, so that every text can be written again.
TEST(Npy, BytesThatAreNoUtf8AreLatin1) {
  const std::string head =
      "{'descr': '|S5', 'fortran_order': False, 'shape': (1,)}\n";
  const std::string bytes = std::string("\x93NUMPY\1\0", 8) +
                            static_cast<char>(head.size()) + '\0' + head +
                            std::string("\xc3\xa9\xc0\x80\xff", 5);
  const std::vector<std::string> texts =
      ParseNpy(bytes, "a.npy").ToStrings("a");
  EXPECT_EQ(texts[0], "\u00e9\u00c0\u0080\u00ff");
  EXPECT_EQ(NpyArray::Text({1}, texts).ToStrings("a"), texts);
}

TEST(Npy, FortranOrderIsTurned) {
  // [[0 1 2] [3 4 5]] column by column.
  const auto array = ParseNpy(
      NpyBytes(NpyHead("|i1", "(2, 3)", true), std::string("\0\3\1\4\2\5", 6)),
      "a.npy");
  EXPECT_THAT(array.ToIntegers(""), ElementsAre(0, 1, 2, 3, 4, 5));
  // Element (i, j, k) of a (2, 2, 2) array is at i + 2 j + 4 k.
  const auto cube = ParseNpy(NpyBytes(NpyHead("|u1", "(2, 2, 2)", true),
                                      std::string("\0\1\2\3\4\5\6\7", 8)),
                             "a.npy");
  EXPECT_THAT(cube.ToIntegers(""), ElementsAre(0, 4, 2, 6, 1, 5, 3, 7));
}

TEST(Npy, OtherByteOrderAndHalfPrecisionAreRead) {
  const auto big = ParseNpy(
      NpyBytes(NpyHead(">i4", "(1,)"), std::string("\0\0\1\2", 4)), "a.npy");
  EXPECT_THAT(big.ToIntegers(""), ElementsAre(258));
  const auto half = ParseNpy(
      NpyBytes(NpyHead("<f2", "(1,)"), std::string("\x00\x3e", 2)), "a.npy");
  EXPECT_THAT(half.ToDoubles(""), ElementsAre(1.5));
}

TEST(Npy, WrongKindOfValueIsNamed) {
  const auto text = NpyArray::Text({1}, {"x"});
  EXPECT_THAT([&] { text.ToDoubles("f: a"); },
              ThrowsMessage<InputError>(HasSubstr("f: a is text (U1 (1,))")));
  const auto floats = NpyArray::Floats({1}, {1});
  EXPECT_THAT([&] { floats.ToIntegers("f: a"); },
              ThrowsMessage<InputError>(HasSubstr("f4 (1,): expected whole")));
  EXPECT_THROW(floats.ToStrings("f: a"), InputError);
  const auto large = NpyArray::Ulongs({1}, {~std::uint64_t{0}});
  EXPECT_THROW(large.ToIntegers("f: a"), InputError);
}

TEST(Npy, FilesAreWrittenAndRead) {
  const std::string path = ::testing::TempDir() + "/npy_test.npy";
  WriteNpy(path, NpyArray::Doubles({2}, {1, 2}));
  EXPECT_THAT(ReadNpy(path).ToDoubles(""), ElementsAre(1, 2));
  std::filesystem::remove(path);
  EXPECT_THROW(ReadNpy(path), InputError);
}

}  // namespace
}  // namespace invsim
