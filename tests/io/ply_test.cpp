// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/ply.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>

#include "error_matcher.h"

namespace invsim {
namespace {

using ::testing::HasSubstr;

// The bytes of typed values, in either byte order.
class Bytes {
 public:
  explicit Bytes(bool big_endian = false) : big_endian_(big_endian) {}
  template <typename T>
  Bytes& Add(std::initializer_list<T> values) {
    for (T value : values) {
      std::string raw(reinterpret_cast<const char*>(&value), sizeof(T));
      if (big_endian_) raw = std::string(raw.rbegin(), raw.rend());
      text_ += raw;
    }
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  bool big_endian_;
  std::string text_;
};

PlyMesh SomeMesh() {
  PlyMesh mesh;
  mesh.vertices.resize(3, 4);
  mesh.vertices << 0, 1, 0, 0.1, 0, 0, 1, 0.2, 0, 0, 0, -0.3;
  mesh.faces = (Faces(3, 2) << 0, 1, 1, 2, 2, 3).finished();
  return mesh;
}

TEST(PlyTest, ReadsAnAsciiMeshAsWrittenByViewers) {
  const PlyMesh mesh = ParsePly(
      "ply\r\nformat ascii 1.0\r\ncomment made by a viewer\r\n"
      "element vertex 4\r\nproperty float x\r\nproperty float y\r\n"
      "property float z\r\nproperty uchar red\r\nproperty uchar green\r\n"
      "property uchar blue\r\nproperty uchar alpha\r\n"
      "property float quality\r\nelement face 1\r\n"
      "property list uchar int vertex_indices\r\n"
      "property list uchar float texcoord\r\nend_header\r\n"
      "0 0 0 255 0 0 255 0.25 \r\n1 0 0 0 255 0 255 1e-3\r\n"
      "1 1 0 0 0 255 255 nan\r\n0 1 0.5 1 2 3 255 4\r\n"
      "4 0 1 2 3 8 0 0 1 0 1 1 0 1 \r\n",
      "t.ply");
  ASSERT_EQ(mesh.vertices.cols(), 4);
  EXPECT_EQ(mesh.vertices.col(3), Vector3d(0, 1, 0.5));
  EXPECT_EQ(mesh.faces, (Faces(3, 2) << 0, 0, 1, 2, 2, 3).finished());
  ASSERT_EQ(mesh.properties.size(), 5);
  EXPECT_EQ(mesh.properties[0].name, "red");
  EXPECT_EQ(mesh.properties[0].type, PlyType::kUint8);
  EXPECT_EQ((*mesh.Find("green"))[1], 255);
  EXPECT_EQ((*mesh.Find("quality"))[1], 1e-3);
  EXPECT_TRUE(std::isnan((*mesh.Find("quality"))[2]));
  EXPECT_EQ(mesh.Find("nx"), nullptr);
}

TEST(PlyTest, ReadsBinaryOfEitherOrderAndSkipsWhatIsNotNeeded) {
  const std::string header =
      " 1.0\nelement camera 2\nproperty list uchar double view\n"
      "property short id\n"
      "element vertex 3\nproperty list uint short neighbours\n"
      "property double z\nproperty int y\nproperty uchar x\n"
      "property ushort weight\n"
      "element face 2\nproperty float area\n"
      "property list int ushort vertex_index\n"
      "element empty 1000000000000\nend_header\n";
  for (bool big : {false, true}) {
    Bytes body(big);
    body.Add<std::uint8_t>({2}).Add<double>({1, 2}).Add<std::int16_t>({5});
    body.Add<std::uint8_t>({0}).Add<std::int16_t>({6});
    for (int i = 0; i < 3; ++i) {
      body.Add<std::uint32_t>({1}).Add<std::int16_t>({7});
      body.Add<double>({0.1 * i}).Add<std::int32_t>({-i});
      body.Add<std::uint8_t>({static_cast<std::uint8_t>(200 + i)});
      body.Add<std::uint16_t>({static_cast<std::uint16_t>(60000 + i)});
    }
    for (int i = 0; i < 2; ++i) {
      body.Add<float>({1}).Add<std::int32_t>({3});
      body.Add<std::uint16_t>({2, 1, 0});
    }
    const std::string format =
        big ? "binary_big_endian" : "binary_little_endian";
    const PlyMesh mesh =
        ParsePly("ply\nformat " + format + header + body.text(), "t.ply");
    ASSERT_EQ(mesh.vertices.cols(), 3);
    EXPECT_EQ(mesh.vertices.col(2), Vector3d(202, -2, 0.1 * 2));
    ASSERT_EQ(mesh.properties.size(), 1);
    EXPECT_EQ((*mesh.Find("weight"))[1], 60001);
    EXPECT_EQ(mesh.faces, (Faces(3, 2) << 2, 2, 1, 1, 0, 0).finished());
  }
}

TEST(PlyTest, WritesWhatReadsBack) {
  PlyMesh mesh = SomeMesh();
  mesh.position_type = PlyType::kFloat64;
  const VectorXd strain = VectorXd::LinSpaced(4, 0, 0.75);
  const Points velocity = Points::Constant(3, 4, -1.5);
  mesh.AddScalar("strain", strain);
  mesh.AddVector({"vx", "vy", "vz"}, velocity);
  Points colors = Points::Zero(3, 4);
  colors.col(1) << 0.2, 1.0, 7.0;
  mesh.AddColors(colors);
  mesh.properties.push_back(
      {"id", (VectorXd(4) << -1, 70000, 2, 3).finished(), PlyType::kInt32});

  const PlyMesh same = ParsePly(FormatPly(mesh), "t.ply");
  EXPECT_EQ(same.vertices, mesh.vertices);
  EXPECT_EQ(same.position_type, PlyType::kFloat64);
  EXPECT_EQ(same.faces, mesh.faces);
  EXPECT_EQ(same.properties.size(), 8);
  EXPECT_EQ(*same.Find("strain"), strain);
  EXPECT_EQ(*same.Find("vy"), VectorXd::Constant(4, -1.5));
  EXPECT_EQ((*same.Find("red"))[1], 51);
  EXPECT_EQ((*same.Find("blue"))[1], 255);
  EXPECT_EQ((*same.Find("id"))[1], 70000);
  EXPECT_EQ(FormatPly(same), FormatPly(mesh));
}

TEST(PlyTest, WritesPositionsAsFloatsUnlessAsked) {
  const std::string bytes = FormatPly(SomeMesh());
  EXPECT_THAT(bytes, HasSubstr("property float x\n"));
  const PlyMesh same = ParsePly(bytes, "t.ply");
  EXPECT_EQ(same.vertices(0, 3), static_cast<double>(0.1f));

  PlyMesh points;
  points.vertices = SomeMesh().vertices;
  EXPECT_THAT(FormatPly(points), ::testing::Not(HasSubstr("face")));
}

TEST(PlyTest, AxesOfDifferentTypesAreWrittenAsDoubles) {
  const PlyMesh mesh = ParsePly(
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty uchar x\n"
      "property float y\nproperty double z\nend_header\n1 300.5 1e-200\n",
      "t");
  EXPECT_EQ(mesh.position_type, PlyType::kFloat64);
  EXPECT_EQ(ParsePly(FormatPly(mesh), "t").vertices, mesh.vertices);
}

TEST(PlyTest, WritesAFileThatReadsBack) {
  const std::string path = ::testing::TempDir() + "ply_test.ply";
  WritePly(path, SomeMesh());
  EXPECT_EQ(ReadPly(path).faces, SomeMesh().faces);
  std::filesystem::remove(path);
  EXPECT_THAT([] { WritePly("/nowhere/x.ply", SomeMesh()); },
              ThrowsInputError("/nowhere/x.ply: cannot be written"));
}

TEST(PlyTest, RefusesToWriteArraysThatDoNotFit) {
  PlyMesh mesh = SomeMesh();
  mesh.AddScalar("strain", VectorXd::Zero(3));
  EXPECT_THROW(FormatPly(mesh), Error);
  mesh = SomeMesh();
  mesh.AddScalar("two words", VectorXd::Zero(4));
  EXPECT_THROW(FormatPly(mesh), Error);
  mesh = SomeMesh();
  mesh.AddScalar("x", VectorXd::Zero(4));
  EXPECT_THROW(FormatPly(mesh), Error);
  mesh = SomeMesh();
  mesh.properties.push_back(
      {"id", VectorXd::Constant(4, 256), PlyType::kUint8});
  EXPECT_THROW(FormatPly(mesh), Error);
}

std::string Ascii(const std::string& vertices, const std::string& rest) {
  return "ply\nformat ascii 1.0\nelement vertex " + vertices +
         "\nproperty float x\nproperty float y\nproperty float z\n" + rest;
}

TEST(PlyTest, CountsNonFinitePositions) {
  const std::string text =
      Ascii("4", "end_header\n0 0 0\n1 nan 0\n0 1 0\n0 0 -inf\n");
  EXPECT_THAT([&] { ParsePly(text, "t.ply"); },
              ThrowsInputError("t.ply: 2 of 4 vertices are not finite, the "
                               "first is vertex 1 (from 0)"));
  PlyReadOptions options;
  options.allow_non_finite = true;
  const PlyMesh mesh = ParsePly(text, "t.ply", options);
  EXPECT_TRUE(std::isnan(mesh.vertices(1, 1)));
  EXPECT_TRUE(std::isinf(mesh.vertices(2, 3)));
}

struct BadPly {
  std::string text;
  const char* message;
};

class BadPlyTest : public ::testing::TestWithParam<BadPly> {};

TEST_P(BadPlyTest, NamesPlaceValueAndExpectation) {
  EXPECT_THAT([] { ParsePly(GetParam().text, "t.ply"); },
              ThrowsInputError(GetParam().message));
}

const std::string kFace =
    "element face 1\nproperty list char int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n";

INSTANTIATE_TEST_SUITE_P(
    All,
    BadPlyTest,
    ::testing::Values(
        BadPly{"ply\nformat ascii 1.0\nelement face 0\nend_header\n",
               "t.ply: no element vertex"},
        BadPly{"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
               "property float y\nproperty list uchar float z\nend_header\n",
               "t.ply: element vertex without property z"},
        BadPly{Ascii("1000000000000", "end_header\n0 0 0\n"),
               "t.ply: 1000000000000 vertices: expected fewer than 2^31"},
        BadPly{Ascii("2000000000", "end_header\n0 0 0\n"),
               "t.ply: 6 bytes left: expected 2000000000 rows"},
        BadPly{Ascii("2", "end_header\n0 0 0\n1 0      \n"),
               "t.ply:9: the line ends: expected a number (z)"},
        BadPly{Ascii("2", "end_header\n0 0 0.00000000\n"),
               "element 'vertex' row 1 (from 0) of 2: the file ends"},
        BadPly{Ascii("1", "end_header\n0 0 0 0\n"),
               "t.ply:8: '0': expected the end of the line"},
        BadPly{Ascii("1", "end_header\n0 0 0\n0 0 0\n"),
               "t.ply:9: '0': expected the end of the file"},
        BadPly{Ascii("1", "end_header\n0 0 zero\n"),
               "t.ply:8: 'zero': expected a number (z)"},
        BadPly{Ascii("3", kFace + "3 0 1 3\n"),
               "element 'face' row 0 (from 0) of 1: vertex 3: expected 0 to 2"},
        BadPly{Ascii("3", kFace + "3 0 1 -1\n"), "vertex -1: expected 0 to 2"},
        BadPly{Ascii("3", kFace + "2 0 1\n"), "2 corners: expected 3 or more"},
        BadPly{Ascii("3", kFace + "-1 0 1\n"), "list of length -1"},
        BadPly{Ascii("3", kFace + "100 0 1 2\n"),
               "t.ply:13: the line ends: expected a whole number"},
        BadPly{Ascii("3",
                     "element face 1\nproperty int vertex_indices\nend_header"
                     "\n0 0 0\n1 0 0\n0 1 0\n7\n"),
               "t.ply: element face without corners"},
        BadPly{"ply\nformat binary_little_endian 1.0\nelement vertex 8000\n"
               "property float x\nproperty float y\nproperty float z\n"
               "end_header\n0123456789",
               "t.ply: 10 bytes left: expected 8000 rows of at least 12 "
               "bytes of element 'vertex'"}));

}  // namespace
}  // namespace invsim
