// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/obj.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "error_matcher.h"
#include "invsim/base/error.h"

namespace invsim {
namespace {

using ::testing::HasSubstr;

constexpr char kTriangle[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(ObjTest, ReadsEveryFormOfACorner) {
  const std::string head =
      std::string(kTriangle) + "vt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n";
  const Faces expected = (Faces(3, 1) << 0, 1, 2).finished();
  for (const char* face :
       {"f 1 2 3", "f -3 -2 -1", "f 1//1 2//1 3//1", "f +1 2 3"}) {
    const ObjMesh mesh = ParseObj(head + face, "t.obj");
    EXPECT_EQ(mesh.faces, expected) << face;
    EXPECT_EQ(mesh.texture_faces.cols(), 0) << face;
    EXPECT_EQ(mesh.texture.cols(), 3) << face;
  }
  for (const char* face :
       {"f 1/3 2/2 3/1", "f 1/3/1 2/2/1 3/1/1", "f -3/-1/-1 -2/-2/1 -1/-3/1"}) {
    const ObjMesh mesh = ParseObj(head + face, "t.obj");
    EXPECT_EQ(mesh.faces, expected) << face;
    EXPECT_EQ(mesh.texture_faces, (Faces(3, 1) << 2, 1, 0).finished()) << face;
  }
}

TEST(ObjTest, ReadsWhatOtherProgramsWrite) {
  const ObjMesh mesh = ParseObj(
      "# exported\r\n"
      "mtllib a.mtl\r\n"
      "o shirt\r\n"
      "v\t1e-1  +2.5 -3.  1.0   # with weight\r\n"
      "  v 1 0 0 0.5 0.5 0.5\r\n"
      "\r\n"
      "v 0 1 \\\r\n 0\r\n"
      "g a#b\r\n"
      "usemtl none\r\n"
      "s off\r\n"
      "f 1 2 3 4\r\n"  // forward reference
      "v 1e-400 1 1",
      "t.obj");
  ASSERT_EQ(mesh.vertices.cols(), 4);
  EXPECT_EQ(mesh.vertices.col(0), Vector3d(0.1, 2.5, -3));
  EXPECT_EQ(mesh.vertices.col(2), Vector3d(0, 1, 0));
  EXPECT_EQ(mesh.vertices.col(3), Vector3d(0, 1, 1));
  EXPECT_EQ(mesh.faces, (Faces(3, 2) << 0, 0, 1, 2, 2, 3).finished());
}

TEST(ObjTest, CutsPolygonsIntoAFan) {
  const ObjMesh mesh = ParseObj(
      "v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 1 0\nf 5 1 2 3 4\n", "t.obj");
  EXPECT_EQ(mesh.faces, (Faces(3, 3) << 4, 4, 4, 0, 1, 2, 1, 2, 3).finished());
}

TEST(ObjTest, WritesWhatReadsBackToTheLastBit) {
  ObjMesh mesh;
  mesh.vertices.resize(3, 4);
  mesh.vertices << 0.1, 1.0 / 3, -1e-300, 5e-324, 1e300, M_PI, 0, -0.0, 1, 2, 3,
      0.1 + 0.2;
  mesh.faces = (Faces(3, 2) << 0, 1, 1, 2, 2, 3).finished();
  mesh.texture = (Points2(2, 3) << 0, 1, std::sqrt(2), 0, 0, 1).finished();
  mesh.texture_faces = (Faces(3, 2) << 0, 0, 1, 1, 2, 2).finished();
  const ObjMesh same = ParseObj(FormatObj(mesh), "t.obj");
  EXPECT_EQ(same.vertices, mesh.vertices);
  EXPECT_EQ(same.faces, mesh.faces);
  EXPECT_EQ(same.texture, mesh.texture);
  EXPECT_EQ(same.texture_faces, mesh.texture_faces);

  mesh.texture.resize(2, 0);
  mesh.texture_faces.resize(3, 0);
  EXPECT_THAT(FormatObj(mesh), HasSubstr("f 1 2 3\n"));
}

TEST(ObjTest, WritesAFileThatReadsBack) {
  const std::string path = ::testing::TempDir() + "obj_test.obj";
  const ObjMesh mesh = ParseObj(std::string(kTriangle) + "f 1 2 3\n", "t");
  WriteObj(path, mesh);
  EXPECT_EQ(ReadObj(path).vertices, mesh.vertices);
  EXPECT_THAT([&] { WriteObj("/nowhere/x.obj", mesh); },
              ThrowsInputError("/nowhere/x.obj: cannot be written"));
}

struct BadObj {
  const char* text;  // after kTriangle
  const char* message;
};

class BadObjTest : public ::testing::TestWithParam<BadObj> {};

TEST_P(BadObjTest, NamesLineValueAndExpectation) {
  EXPECT_THAT(
      [&] { ParseObj(kTriangle + std::string(GetParam().text), "t.obj"); },
      ThrowsInputError(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    All,
    BadObjTest,
    ::testing::Values(
        BadObj{"v 1 nan 0", "t.obj:4: 'nan': expected a finite number (y of"},
        BadObj{"v 1 -inf 0", "t.obj:4: '-inf': expected a finite number"},
        BadObj{"v 1 1e999 0", "t.obj:4: '1e999': expected a finite number"},
        BadObj{"v 1 2", "t.obj:4: the line ends: expected a number (z of v)"},
        BadObj{"v 1 2,5 3", "t.obj:4: '2,5': expected a number (y of v)"},
        BadObj{"vt 1", "t.obj:4: the line ends: expected a number (v of vt)"},
        BadObj{"\nf 1 2 4", "t.obj:5: vertex 4: expected 1 to 3"},
        BadObj{"f 1 2 0", "t.obj:4: '0': expected a vertex number from 1"},
        BadObj{"f 1 2 -4", "t.obj:4: '-4': expected a vertex number from 1"},
        BadObj{"f 1 2 99999999999999999999", "expected a whole number"},
        BadObj{"f 1 2 4294967297", "vertex 4294967297: expected 1 to 3"},
        BadObj{"f 1 2 2.5", "t.obj:4: '2.5': expected a whole number"},
        BadObj{"f 1 2", "t.obj:4: 2 corners: expected a face of three"},
        BadObj{"f 1/ 2/ 3/", "t.obj:4: '1/': expected v/vt"},
        BadObj{"f 1/1/1/1 2 3", "expected a whole number (normal"},
        BadObj{"vt 0 0\nf 1/1 2/1 3/2", "t.obj:5: vt 2: expected 1 to 1"},
        BadObj{"vt 0 0\nf 1/1 2/1 3", "t.obj:5: corner without vt: expected"},
        BadObj{"vt 0 0\nf 1 2 3\nf 1/1 2/1 3/1",
               "t.obj:6: corner with vt: expected none like the face of line"},
        BadObj{"{\"a\": 1}", "t.obj:4: '{\"a\":': expected a statement"}));

TEST(ObjTest, RefusesOtherFiles) {
  EXPECT_THAT([] { ParseObj("", "t.obj"); },
              ThrowsInputError("t.obj: no vertex"));
  EXPECT_THAT([] { ParseObj("hello\n", "t.obj"); },
              ThrowsInputError("t.obj: no vertex"));
  EXPECT_THAT([] { ParseObj(std::string("\x89PNG\r\n\0\x01", 8), "t.obj"); },
              ThrowsInputError("t.obj:1: '?PNG'"));
  EXPECT_THAT([] { ReadObj("/nowhere/x.obj"); },
              ThrowsInputError("/nowhere/x.obj: cannot be opened: No such"));
  EXPECT_THAT([] { ReadObj("/"); }, ThrowsInputError("/: is a directory"));
}

}  // namespace
}  // namespace invsim
