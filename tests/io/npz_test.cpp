// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/npz.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "invsim/base/error.h"

namespace invsim {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// What NumPy 1.24's savez_compressed writes for f = [[0 1 2] [3 4 5]] as '>i4'
// in Fortran order, o = an object array holding a dict, z = 2.5 (0-d). Its
// local headers carry 64-bit sizes.
// clang-format off
constexpr unsigned char kDeflated[] = {
    80, 75, 3, 4, 20, 0, 0, 0, 8, 0, 0, 0, 33, 0, 93, 67, 203, 137, 83, 0, 0, 0,
    152, 0, 0, 0, 5, 0, 20, 0, 102, 46, 110, 112, 121, 1, 0, 16, 0, 152, 0, 0,
    0, 0, 0, 0, 0, 83, 0, 0, 0, 0, 0, 0, 0, 155, 236, 23, 234, 27, 16, 201, 200,
    80, 198, 80, 173, 158, 146, 90, 156, 92, 164, 110, 165, 160, 110, 151, 105,
    162, 174, 163, 160, 158, 150, 95, 84, 82, 148, 152, 23, 159, 95, 148, 146,
    10, 18, 15, 41, 42, 77, 5, 10, 23, 103, 36, 22, 164, 2, 185, 26, 70, 58, 10,
    198, 154, 58, 10, 181, 10, 228, 3, 46, 6, 8, 96, 6, 98, 70, 32, 102, 1, 98,
    38, 32, 102, 5, 0, 80, 75, 3, 4, 20, 0, 0, 0, 8, 0, 0, 0, 33, 0, 210, 163,
    73, 51, 206, 0, 0, 0, 35, 1, 0, 0, 5, 0, 20, 0, 111, 46, 110, 112, 121, 1,
    0, 16, 0, 35, 1, 0, 0, 0, 0, 0, 0, 206, 0, 0, 0, 0, 0, 0, 0, 155, 236, 23,
    234, 27, 16, 201, 200, 80, 198, 80, 173, 158, 146, 90, 156, 92, 164, 110,
    165, 160, 94, 227, 175, 174, 163, 160, 158, 150, 95, 84, 82, 148, 152, 23,
    159, 95, 148, 146, 10, 18, 118, 75, 204, 41, 78, 5, 138, 23, 103, 36, 22,
    164, 2, 249, 26, 154, 58, 10, 181, 10, 148, 1, 174, 6, 230, 228, 188, 210,
    220, 130, 74, 189, 228, 252, 162, 84, 189, 220, 210, 156, 146, 204, 196,
    162, 162, 196, 74, 174, 248, 162, 212, 228, 252, 188, 226, 146, 162, 210,
    228, 18, 174, 66, 6, 136, 42, 174, 188, 20, 136, 108, 33, 163, 55, 67, 107,
    33, 147, 51, 99, 82, 33, 115, 123, 33, 75, 80, 33, 171, 134, 55, 163, 38,
    84, 81, 74, 73, 101, 65, 42, 87, 33, 91, 4, 19, 3, 3, 131, 191, 69, 33, 123,
    103, 71, 123, 33, 71, 80, 33, 167, 134, 55, 115, 4, 35, 80, 172, 166, 144,
    203, 207, 207, 207, 235, 63, 16, 128, 9, 111, 251, 146, 66, 238, 164, 206,
    216, 66, 158, 218, 66, 94, 176, 138, 196, 66, 62, 111, 198, 226, 196, 146,
    66, 254, 36, 61, 0, 80, 75, 3, 4, 20, 0, 0, 0, 8, 0, 0, 0, 33, 0, 53, 180,
    58, 147, 71, 0, 0, 0, 136, 0, 0, 0, 5, 0, 20, 0, 122, 46, 110, 112, 121, 1,
    0, 16, 0, 136, 0, 0, 0, 0, 0, 0, 0, 71, 0, 0, 0, 0, 0, 0, 0, 155, 236, 23,
    234, 27, 16, 201, 200, 80, 198, 80, 173, 158, 146, 90, 156, 92, 164, 110,
    165, 160, 110, 147, 102, 161, 174, 163, 160, 158, 150, 95, 84, 82, 148, 152,
    23, 159, 95, 148, 146, 10, 18, 119, 75, 204, 41, 78, 5, 138, 23, 103, 36,
    22, 164, 2, 249, 26, 154, 58, 10, 181, 10, 20, 1, 46, 6, 48, 96, 113, 0, 0,
    80, 75, 1, 2, 20, 3, 20, 0, 0, 0, 8, 0, 0, 0, 33, 0, 93, 67, 203, 137, 83,
    0, 0, 0, 152, 0, 0, 0, 5, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 128, 1, 0, 0, 0,
    0, 102, 46, 110, 112, 121, 80, 75, 1, 2, 20, 3, 20, 0, 0, 0, 8, 0, 0, 0, 33,
    0, 210, 163, 73, 51, 206, 0, 0, 0, 35, 1, 0, 0, 5, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 128, 1, 138, 0, 0, 0, 111, 46, 110, 112, 121, 80, 75, 1, 2, 20, 3,
    20, 0, 0, 0, 8, 0, 0, 0, 33, 0, 53, 180, 58, 147, 71, 0, 0, 0, 136, 0, 0, 0,
    5, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 128, 1, 143, 1, 0, 0, 122, 46, 110, 112,
    121, 80, 75, 5, 6, 0, 0, 0, 0, 3, 0, 3, 0, 153, 0, 0, 0, 13, 2, 0, 0, 0, 0};
// clang-format on

std::string Compressed() {
  return {reinterpret_cast<const char*>(kDeflated), sizeof(kDeflated)};
}

TEST(Npz, NumPysArchiveIsRead) {
  const Npz npz = Npz::Parse(Compressed(), "a.npz");
  EXPECT_THAT(npz.Names(), ElementsAre("f", "o", "z"));
  EXPECT_THAT(npz.Integers("f", {2, 3}), ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(npz.Doubles("z", {}), ElementsAre(2.5));
}

TEST(Npz, PickledArrayIsRefusedOnlyWhenAskedFor) {
  const Npz npz = Npz::Parse(Compressed(), "a.npz");
  EXPECT_TRUE(npz.Has("o"));
  EXPECT_THAT([&] { npz.Array("o"); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("a.npz: o: holds"),
                                              HasSubstr("python3 -c"))));
}

TEST(Npz, PickleFilesAreRefusedWithTheRemedyInOneLine) {
  for (const std::string& start :
       {std::string("\x80\x02}q\x01(U\x01J"), std::string("(dp0\nS'J'")}) {
    EXPECT_THAT([&] { Npz::Parse(start, "SMPL.pkl"); },
                ThrowsMessage<InputError>(
                    AllOf(HasSubstr("SMPL.pkl: is a Python pickle"),
                          HasSubstr("python3 -c"),
                          ::testing::Not(HasSubstr("\n")))));
  }
}

TEST(Npz, ArraysSurviveInTheirOrder) {
  const NpzArrays arrays = {{"trans", NpyArray::Doubles({1, 3}, {1, 2, 3})},
                            {"gender", NpyArray::Text({}, {"neutral"})}};
  const Npz npz = Npz::Parse(FormatNpz(arrays), "a.npz");
  EXPECT_THAT(npz.Names(), ElementsAre("trans", "gender"));
  EXPECT_THAT(npz.Doubles("trans", {-1, 3}), ElementsAre(1, 2, 3));
  EXPECT_THAT(npz.Array("gender").ToStrings(""), ElementsAre("neutral"));
}

TEST(Npz, EqualArraysGiveEqualBytes) {
  const NpzArrays arrays = {{"a", NpyArray::Doubles({2}, {1, 2})}};
  EXPECT_EQ(FormatNpz(arrays), FormatNpz(arrays));
}

TEST(Npz, WrongShapeIsNamed) {
  const Npz npz = Npz::Parse(
      FormatNpz({{"trans", NpyArray::Floats({2, 2}, {1, 2, 3, 4})}}), "a.npz");
  EXPECT_THAT(
      [&] {
        npz.Doubles("trans", {-1, 3});
      },
      ThrowsMessage<InputError>(
          "a.npz: trans is f4 (2, 2): expected shape (N, 3)"));
}

TEST(Npz, MissingArrayIsNamedWithThoseThere) {
  const Npz npz =
      Npz::Parse(FormatNpz({{"b", NpyArray::Doubles({}, {1})}}), "a.npz");
  EXPECT_THAT(
      [&] { npz.Array("poses"); },
      ThrowsMessage<InputError>("a.npz: has no array poses (it has: b)"));
}

TEST(Npz, FilesAreWrittenAndRead) {
  const std::string path = ::testing::TempDir() + "/npz_test.npz";
  WriteNpz(path, {{"a", NpyArray::Doubles({2}, {1, 2})}});
  EXPECT_THAT(ReadNpz(path).Doubles("a", {2}), ElementsAre(1, 2));
  std::filesystem::remove(path);
  EXPECT_THAT([&] { ReadNpz(path); },
              ThrowsMessage<InputError>(HasSubstr(path)));
}

}  // namespace
}  // namespace invsim
