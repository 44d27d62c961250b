// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/lzf.h"

#include <gtest/gtest.h>

namespace invsim {
namespace {

using namespace std::string_literals;

TEST(LzfTest, UnpacksLiteralsAndRuns) {
  EXPECT_EQ(UnpackLzf("", 0), "");
  EXPECT_EQ(UnpackLzf("\x02"
                      "abc",
                      3),
            "abc");
  // Length 1 + 2 from 3 back.
  EXPECT_EQ(UnpackLzf("\x02"
                      "abc\x20\x02"s,
                      6),
            "abcabc");
  // Length 3 + 2 from 1 back: a run that overlaps itself.
  EXPECT_EQ(UnpackLzf("\x01"
                      "ab\x60\x00"s,
                      7),
            "abbbbbb");
  // Length 7 + 2 + 4.
  EXPECT_EQ(UnpackLzf("\x00"
                      "a\xe0\x04\x00"s,
                      14),
            std::string(14, 'a'));
  // A distance of two bytes: 300 = 256 + 43 + 1.
  std::string packed;
  std::string text;
  for (int i = 0; i < 15; ++i) {
    const std::string piece(20, static_cast<char>('a' + i));
    packed += "\x13" + piece;
    text += piece;
  }
  EXPECT_EQ(UnpackLzf(packed + "\x21\x2b", 303), text + "aaa");
}

TEST(LzfTest, RefusesDamage) {
  EXPECT_FALSE(
      UnpackLzf("\x02"
                "abc",
                4));  // too few
  EXPECT_FALSE(
      UnpackLzf("\x02"
                "abc",
                2));  // too many
  EXPECT_FALSE(
      UnpackLzf("\x03"
                "abc",
                4));  // literal cut short
  EXPECT_FALSE(
      UnpackLzf("\x02"
                "abc\x20\x03"s,
                6));  // before the start
  EXPECT_FALSE(
      UnpackLzf("\x02"
                "abc\x20"s,
                6));  // distance missing
  EXPECT_FALSE(
      UnpackLzf("\x02"
                "abc\xe0"s,
                12));  // length missing
  EXPECT_FALSE(UnpackLzf("abc", std::size_t{1} << 60));
}

}  // namespace
}  // namespace invsim
