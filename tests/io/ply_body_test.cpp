// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/ply_body.h"

#include <gtest/gtest.h>

#include <cstring>

#include "error_matcher.h"

namespace invsim {
namespace {

using namespace std::string_literals;

PlyHeader Header(PlyFormat format,
                 std::int64_t count,
                 const std::vector<PlyType>& types) {
  PlyHeader header;
  header.format = format;
  header.elements.push_back({"thing", count, {}});
  for (PlyType type : types) {
    header.elements[0].properties.push_back({"p", type});
  }
  return header;
}

const std::string kName = "t.ply";

TEST(PlyBodyTest, ReadsEveryTypeOfEitherByteOrder) {
  const PlyHeader little = Header(PlyFormat::kBinaryLittleEndian, 0, {});
  const PlyHeader big = Header(PlyFormat::kBinaryBigEndian, 0, {});
  const struct {
    PlyType type;
    std::string bytes;  // most significant first
    double value;
  } cases[] = {
      {PlyType::kInt8, "\xfe"s, -2},
      {PlyType::kUint8, "\xfe"s, 254},
      {PlyType::kInt16, "\xff\x00"s, -256},
      {PlyType::kUint16, "\xff\x00"s, 65280},
      {PlyType::kInt32, "\x80\x00\x00\x00"s, -2147483648.0},
      {PlyType::kUint32, "\x80\x00\x00\x01"s, 2147483649.0},
      {PlyType::kFloat32, "\xbf\xa0\x00\x00"s, -1.25},
      {PlyType::kFloat64,
       "\x40\x09\x21\xfb\x54\x44\x2d\x18"s,
       3.141592653589793},
  };
  for (const auto& c : cases) {
    EXPECT_EQ(OpenPlyBody(c.bytes, big, kName)->Real(c.type, "p"), c.value);
    const std::string reversed(c.bytes.rbegin(), c.bytes.rend());
    EXPECT_EQ(OpenPlyBody(reversed, little, kName)->Real(c.type, "p"), c.value);
    if (!IsInteger(c.type)) continue;
    EXPECT_EQ(OpenPlyBody(c.bytes, big, kName)->Integer(c.type, "p"), c.value);
  }
}

TEST(PlyBodyTest, RefusesMoreRowsThanBytes) {
  for (PlyFormat format : {PlyFormat::kAscii, PlyFormat::kBinaryBigEndian}) {
    const PlyHeader header =
        Header(format, 1000000000000, {PlyType::kInt16, PlyType::kInt16});
    EXPECT_THAT(
        [&] {
          OpenPlyBody("1 2\n", header, kName)->BeginElement(header.elements[0]);
        },
        ThrowsInputError("t.ply: 4 bytes left: expected 1000000000000 rows of "
                         "at least 4 bytes of element 'thing'"));
  }
}

TEST(PlyBodyTest, AcceptsAsManyRowsAsBytes) {
  const PlyHeader header = Header(PlyFormat::kAscii, 3, {PlyType::kInt16});
  const auto body = OpenPlyBody("1\n2\n3", header, kName);
  body->BeginElement(header.elements[0]);
  for (int row = 1; row <= 3; ++row) {
    body->BeginRow();
    EXPECT_EQ(body->Integer(PlyType::kInt16, "p"), row);
    body->EndRow();
  }
  body->Finish();
}

TEST(PlyBodyTest, NamesThePlaceOfATruncation) {
  const PlyHeader header =
      Header(PlyFormat::kBinaryLittleEndian, 2, {PlyType::kUint8});
  const auto body = OpenPlyBody("\1\2", header, kName);
  body->BeginElement(header.elements[0]);
  body->BeginRow();
  body->BeginRow();
  EXPECT_THAT([&] { body->Real(PlyType::kFloat32, "p"); },
              ThrowsInputError("t.ply: element 'thing' row 1 (from 0) of 2: 2 "
                               "bytes left: expected 4 or more"));
  EXPECT_THAT([&] { body->Finish(); },
              ThrowsInputError("t.ply: 2 bytes after the last element"));
}

TEST(PlyBodyTest, KeepsAsciiToTheTypeAndTheLine) {
  const PlyHeader header = Header(PlyFormat::kAscii, 1, {PlyType::kUint8});
  const auto body = OpenPlyBody("256 -1 2.5 -1e39 7 8\n9", header, kName);
  body->BeginElement(header.elements[0]);
  body->BeginRow();
  EXPECT_THAT([&] { body->Integer(PlyType::kUint8, "red"); },
              ThrowsInputError("t.ply:1: '256': expected a uchar (red)"));
  EXPECT_THAT([&] { body->Real(PlyType::kUint32, "red"); },
              ThrowsInputError("t.ply:1: '-1': expected a uint (red)"));
  EXPECT_THAT([&] { body->Real(PlyType::kInt8, "red"); },
              ThrowsInputError("t.ply:1: '2.5': expected a whole number"));
  EXPECT_THAT([&] { body->Real(PlyType::kFloat32, "x"); },
              ThrowsInputError("t.ply:1: '-1e39': expected a float (x)"));
  EXPECT_EQ(body->Real(PlyType::kInt8, "red"), 7);
  EXPECT_THAT([&] { body->EndRow(); },
              ThrowsInputError("t.ply:1: '8': expected the end of the line"));
  EXPECT_THAT([&] { body->Finish(); },
              ThrowsInputError("t.ply:2: '9': expected the end of the file"));
  EXPECT_THAT([&] { body->BeginRow(); },
              ThrowsInputError("row 1 (from 0) of 1: the file ends"));
}

}  // namespace
}  // namespace invsim
