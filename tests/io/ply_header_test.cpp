// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/ply_header.h"

#include <gtest/gtest.h>

#include "error_matcher.h"

namespace invsim {
namespace {

TEST(PlyHeaderTest, ReadsElementsAndProperties) {
  const std::string text =
      "ply\nformat binary_big_endian 1.0\ncomment by hand\nobj_info x 1\n\n"
      "element vertex 12\nproperty float x\nproperty float64 y\n"
      "element face 1000000000000\n"
      "property list uchar int32 vertex_indices\nproperty uint8 flag\n"
      "end_header\n";
  const PlyHeader header = ParsePlyHeader(text + "\nrest", "t.ply");
  EXPECT_EQ(header.format, PlyFormat::kBinaryBigEndian);
  EXPECT_EQ(header.size, text.size());
  EXPECT_EQ(header.num_lines, 12);
  ASSERT_EQ(header.elements.size(), 2);
  const PlyElementHeader& vertex = header.elements[0];
  EXPECT_EQ(vertex.name, "vertex");
  EXPECT_EQ(vertex.count, 12);
  EXPECT_EQ(vertex.Find("y"), 1);
  EXPECT_EQ(vertex.Find("z"), -1);
  EXPECT_EQ(vertex.properties[1].type, PlyType::kFloat64);
  EXPECT_EQ(vertex.SmallestRow(), 12);
  const PlyElementHeader& face = header.elements[1];
  EXPECT_EQ(face.count, 1000000000000);
  EXPECT_TRUE(face.properties[0].is_list);
  EXPECT_EQ(face.properties[0].count_type, PlyType::kUint8);
  EXPECT_EQ(face.properties[0].type, PlyType::kInt32);
  EXPECT_EQ(face.SmallestRow(), 2);
}

TEST(PlyHeaderTest, EndsLinesAsTheFirstOne) {
  const std::string body = "element vertex 1";
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const std::string text = "ply" + end + "format ascii 1.0" + end + body +
                             end + "end_header" + end;
    // A body that begins with a line feed of its own.
    EXPECT_EQ(ParsePlyHeader(text + "\n", "t").size, text.size());
  }
}

TEST(PlyHeaderTest, KnowsTheTypes) {
  EXPECT_STREQ(PlyName(PlyType::kUint16), "ushort");
  EXPECT_EQ(PlySize(PlyType::kUint16), 2);
  EXPECT_EQ(PlySize(PlyType::kFloat64), 8);
  EXPECT_TRUE(IsInteger(PlyType::kUint32));
  EXPECT_FALSE(IsInteger(PlyType::kFloat32));
}

struct BadHeader {
  const char* text;
  const char* message;
};

class BadPlyHeaderTest : public ::testing::TestWithParam<BadHeader> {};

TEST_P(BadPlyHeaderTest, NamesLineValueAndExpectation) {
  EXPECT_THAT([] { ParsePlyHeader(GetParam().text, "t.ply"); },
              ThrowsInputError(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    All,
    BadPlyHeaderTest,
    ::testing::Values(
        BadHeader{"", "t.ply: starts with '': expected a PLY file"},
        BadHeader{"PK\x03\x04", "t.ply: starts with 'PK?': expected a PLY"},
        BadHeader{"plywood\n", "t.ply:1: 'plywood': expected 'ply'"},
        BadHeader{"ply\nformat ascii 1.0\n", "21 bytes without end_header"},
        BadHeader{"ply\nend_header\n", "t.ply:2: 'end_header': expected 'form"},
        BadHeader{"ply\nformat ascii 2.0\n", "t.ply:2: 'format ascii 2.0'"},
        BadHeader{"ply\nformat text 1.0\n", "t.ply:2: 'text': expected ascii"},
        BadHeader{"ply\nformat ascii 1.0\nelement vertex -1\n",
                  "t.ply:3: '-1': expected a count of 0 or more"},
        BadHeader{"ply\nformat ascii 1.0\nelement vertex 1e3\n",
                  "t.ply:3: '1e3': expected a count"},
        BadHeader{
            "ply\nformat ascii 1.0\nelement vertex 99999999999999999999\n",
            "t.ply:3: '99999999999999999999': expected a count"},
        BadHeader{"ply\nformat ascii 1.0\nelement a 1\nelement a 1\n",
                  "t.ply:4: 'element a 1': expected each element once"},
        BadHeader{"ply\nformat ascii 1.0\nproperty float x\n",
                  "t.ply:3: 'property float x': expected an element before"},
        BadHeader{"ply\nformat ascii 1.0\nelement a 1\nproperty half x\n",
                  "t.ply:4: 'half': expected a type: char"},
        BadHeader{"ply\nformat ascii 1.0\nelement a 1\nproperty float\n",
                  "t.ply:4: 'property float': expected 'property TYPE NAME'"},
        BadHeader{"ply\nformat ascii 1.0\nelement a 1\n"
                  "property list float int x\n",
                  "t.ply:4: 'float': expected an integer type for a list"},
        BadHeader{"ply\nformat ascii 1.0\nelement a 1\n"
                  "property int x\nproperty int x\n",
                  "t.ply:5: 'x': expected each property of an element once"},
        BadHeader{"ply\nformat ascii 1.0\nvertices 3\n",
                  "t.ply:3: 'vertices 3': expected element, property or"}));

TEST(PlyHeaderTest, BoundsTheNumberOfProperties) {
  std::string text = "ply\nformat ascii 1.0\nelement a 1\n";
  for (int i = 0; i < 2000; ++i) {
    text += "property int p" + std::to_string(i) + "\n";
  }
  EXPECT_THAT([&] { ParsePlyHeader(text + "end_header\n", "t.ply"); },
              ThrowsInputError("t.ply:1004: 'property int p1000': expected at "
                               "most 1000 of a kind"));
}

}  // namespace
}  // namespace invsim
