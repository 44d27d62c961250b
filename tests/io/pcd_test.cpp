// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/pcd.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "error_matcher.h"

namespace invsim {
namespace {

using namespace std::string_literals;

template <typename T>
std::string Raw(T value) {
  return std::string(reinterpret_cast<const char*>(&value), sizeof(T));
}

// The header PCL 1.13 writes.
std::string Header(const std::string& fields, int points) {
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n" + fields +
         "WIDTH " + std::to_string(points) +
         "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " +
         std::to_string(points) + "\n";
}

const std::string kXyz = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n";

TEST(PcdTest, ReadsAscii) {
  const Points points = ParsePcd(
      Header("FIELDS x rgb y normal z\nSIZE 4 4 4 4 8\nTYPE F U F F F\n"
             "COUNT 1 1 1 3 1\n",
             3) +
          "DATA ascii\n1 4291348680 2 0 0 1 3\nnan 0 nan 0 0 0 nan\n"
          "-1 0 1e-3 nan nan nan 0.1\n",
      "t.pcd");
  ASSERT_EQ(points.cols(), 3);
  EXPECT_EQ(points.col(0), Vector3d(1, 2, 3));
  EXPECT_TRUE(std::isnan(points(2, 1)));
  EXPECT_EQ(points.col(2), Vector3d(-1, 1e-3, 0.1));
}

TEST(PcdTest, ReadsBinaryRowsOfAnyType) {
  const std::string header = Header(
      "FIELDS z _ y label x\nSIZE 8 1 2 4 4\nTYPE F U I U F\n"
      "COUNT 1 5 1 1 1\n",
      2);
  std::string rows;
  for (int i = 0; i < 2; ++i) {
    rows += Raw(0.1 * (i + 1)) + "     " + Raw(std::int16_t(-7 - i)) +
            Raw(std::uint32_t(9)) + Raw(1.5f);
  }
  const Points points = ParsePcd(header + "DATA binary\n" + rows, "t.pcd");
  ASSERT_EQ(points.cols(), 2);
  EXPECT_EQ(points.col(1), Vector3d(1.5, -8, 0.2));
}

// Of no points there are no bytes, wherever a field would begin.
TEST(PcdTest, ReadsBinaryRowsOfNoPoints) {
  const std::string header = Header("FIELDS a x y z\n", 0) + "DATA binary\n";
  EXPECT_EQ(ParsePcd(header, "t.pcd").cols(), 0);
}

// (i, 0.5, -2), i = 0 .. 5, as PCL 1.13 compresses it.
const std::string kCompressed =
    "\x2a\x00\x00\x00\x48\x00\x00\x00\x01\x00\x00\x40\x00\x01\x80\x3f"
    "\x20\x05\x03\x40\x00\x00\x40\x20\x03\x00\x80\x20\x03\x00\xa0\x20"
    "\x03\x00\x00\x40\x13\xe0\x0b\x03\x00\xc0\x20\x2b\xe0\x06\x03\x01"
    "\x00\xc0"s;

TEST(PcdTest, ReadsCompressedBlocks) {
  const std::string header = Header(kXyz, 6) + "DATA binary_compressed\n";
  const Points points = ParsePcd(header + kCompressed, "t.pcd");
  ASSERT_EQ(points.cols(), 6);
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(points.col(i), Vector3d(i, 0.5, -2)) << i;
  }
}

TEST(PcdTest, ReadsOldAndOrganisedHeaders) {
  const std::string fields = "COLUMNS x y z\n";
  EXPECT_EQ(ParsePcd(fields + "WIDTH 2\nHEIGHT 2\nPOINTS 4\nDATA ascii\n"
                              "0 0 0\r\n1 0 0\n2 0 0\n3 0 0",
                     "t")
                .cols(),
            4);
  EXPECT_EQ(ParsePcd(fields + "POINTS 1\nDATA ascii\n0 0 0\n", "t").cols(), 1);
  EXPECT_EQ(ParsePcd(fields + "WIDTH 1\nDATA ascii\n0 0 0\n", "t").cols(), 1);
}

struct BadPcd {
  std::string text;
  const char* message;
};

class BadPcdTest : public ::testing::TestWithParam<BadPcd> {};

TEST_P(BadPcdTest, NamesPlaceValueAndExpectation) {
  EXPECT_THAT([] { ParsePcd(GetParam().text, "t.pcd"); },
              ThrowsInputError(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    All,
    BadPcdTest,
    ::testing::Values(
        BadPcd{"", "t.pcd: no line DATA"},
        BadPcd{"ply\n", "t.pcd:1: 'ply': expected a line of a PCD header"},
        BadPcd{"FIELDS x y\nPOINTS 1\nDATA ascii\n0 0\n",
               "t.pcd: no field z: expected FIELDS x y z"},
        BadPcd{"FIELDS x y z\nSIZE 4 4\n", "t.pcd:2: the line ends: expected"},
        BadPcd{"FIELDS x y z\nSIZE 4 4 4 4\n",
               "t.pcd:2: '4': expected the end of the line"},
        BadPcd{"FIELDS x y z\nSIZE 4 4 16\n", "t.pcd:2: '16': expected 0 to 8"},
        BadPcd{"FIELDS x y z\nTYPE F F D\n", "t.pcd:2: 'D': expected a TYPE"},
        BadPcd{"FIELDS x y z\nSIZE 4 4 2\nPOINTS 1\nDATA ascii\n0 0 0\n",
               "field z of type F, size 2, count 1: expected one number"},
        BadPcd{"FIELDS x y z\nCOUNT 1 3 1\nPOINTS 1\nDATA ascii\n0 0 0\n",
               "field y of type F, size 4, count 3: expected one number"},
        BadPcd{"FIELDS x y z\nWIDTH 2\nHEIGHT 2\nPOINTS 5\nDATA ascii\n",
               "t.pcd: POINTS 5: expected WIDTH 2 times HEIGHT 2"},
        BadPcd{"FIELDS x y z\nDATA ascii\n", "t.pcd: POINTS -"},
        BadPcd{Header(kXyz, 1) + "DATA base64\n",
               "'base64': expected ascii, binary or binary_compressed"},
        BadPcd{"FIELDS x y z\nPOINTS 1000000000000\n",
               "t.pcd:2: '1000000000000': expected 0 to 2147483647"},
        BadPcd{Header(kXyz, 2000000000) + "DATA ascii\n0 0 0\n",
               "t.pcd: 6 bytes after the header: expected 2000000000 points"},
        BadPcd{Header(kXyz, 2000000000) + "DATA binary\n0123456789ab",
               "t.pcd: 12 bytes after the header: expected 2000000000 points "
               "of 12 bytes or more"},
        BadPcd{Header(kXyz, 2) + "DATA ascii\n0 0 0.000000000\n",
               "t.pcd: 1 points: expected POINTS 2"},
        BadPcd{Header(kXyz, 1) + "DATA ascii\n0 0 0\n1 1 1\n",
               "'1': expected the end of the file"},
        BadPcd{Header(kXyz, 1) + "DATA ascii\n0 x 0\n",
               "'x': expected a number (y)"},
        BadPcd{Header(kXyz, 6) + "DATA binary_compressed\n1234567",
               "t.pcd: 7 bytes after the header: expected 8 or more"},
        BadPcd{Header(kXyz, 6) + "DATA binary_compressed\n" +
                   kCompressed.substr(0, 40),
               "t.pcd: 32 compressed bytes: expected 42"},
        BadPcd{Header(kXyz, 7) + "DATA binary_compressed\n" + kCompressed,
               "t.pcd: 72 uncompressed bytes: expected 7 points of 12"},
        BadPcd{Header(kXyz, 6) + "DATA binary_compressed\n" +
                   kCompressed.substr(0, 8) + std::string(42, '\xff'),
               "t.pcd: damaged compressed block"}));

}  // namespace
}  // namespace invsim
