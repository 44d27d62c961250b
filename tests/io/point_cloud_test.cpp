// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/point_cloud.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "error_matcher.h"
#include "invsim/io/file.h"
#include "invsim/io/npy.h"
#include "invsim/io/ply.h"

namespace invsim {
namespace {

// The same three points in every format.
std::map<std::string, std::string> SamePoints() {
  PlyMesh ply;
  ply.vertices = (Points(3, 3) << 1, 2, 3, 0.5, 0.25, 0, -4, -5, -6).finished();
  ply.AddScalar("quality", VectorXd::Zero(3));
  return {
      {"ply", FormatPly(ply)},
      {"pcd",
       "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
       "WIDTH 3\nHEIGHT 1\nPOINTS 3\nDATA ascii\n1 0.5 -4\n2 0.25 -5\n3 0 -6"},
      {"obj", "v 1 0.5 -4\nv 2 0.25 -5\nv 3 0 -6\nf 1 2 3\n"},
      {"xyz", "# x y z\n1 0.5 -4\n\n2 0.25 -5\n3 0 -6\n"},
      {"txt", "1\t0.5\t-4 255 0 0\r\n2\t0.25\t-5 0 0 0\r\n3\t0\t-6\r\n"},
      {"npy",
       FormatNpy(
           NpyArray::Floats({3, 3}, {1, 0.5, -4, 2, 0.25, -5, 3, 0, -6}))}};
}

TEST(PointCloudTest, ReadsEveryFormat) {
  const Points expected =
      (Points(3, 3) << 1, 2, 3, 0.5, 0.25, 0, -4, -5, -6).finished();
  std::map<std::string, std::string> files = SamePoints();
  for (const std::string& extension : PointExtensions()) {
    const std::string path =
        ::testing::TempDir() + "point_cloud_test." + extension;
    WriteFileBytes(path, files.at(extension));
    EXPECT_EQ(ReadPoints(path), expected) << extension;
    std::filesystem::remove(path);
  }
}

TEST(PointCloudTest, RefusesOrDropsNonFinitePoints) {
  const std::string text = "0 0 0\nnan 0 0\n1 1 1\n0 0 inf\n2 2 2\n";
  EXPECT_THAT([&] { ParsePoints(text, "xyz", "t.xyz"); },
              ThrowsInputError("t.xyz: 2 of 5 points are not finite, the first "
                               "is point 1 (from 0)"));
  int num_dropped = -1;
  const Points points = ParsePoints(
      text, "xyz", "t.xyz", {.drop_non_finite = true}, &num_dropped);
  EXPECT_EQ(num_dropped, 2);
  EXPECT_EQ(points, (Points(3, 3) << 0, 1, 2, 0, 1, 2, 0, 1, 2).finished());
  EXPECT_THAT(
      [&] {
        ParsePoints("nan 0 0\n", "xyz", "t.xyz", {.drop_non_finite = true});
      },
      ThrowsInputError("t.xyz: 1 of 1 points are not finite"));
}

TEST(PointCloudTest, DescribesItsOptions) {
  PointReadOptions options;
  OptionTable table;
  table.AddSection("points", &options);
  Config config;
  config.Assign("points.drop_non_finite=true", "--set");
  table.Read(config);
  EXPECT_TRUE(options.drop_non_finite);
}

TEST(PointCloudTest, RefusesWhatIsNoCloud) {
  EXPECT_THAT([] { ParsePoints("0 0 0", "las", "t.las"); },
              ThrowsInputError("t.las: extension 'las': expected a point "
                               "cloud, one of ply, pcd, obj, xyz, txt, npy"));
  EXPECT_THAT([] { ParsePoints("# none\n", "xyz", "t.xyz"); },
              ThrowsInputError("t.xyz: no point: expected at least one"));
  EXPECT_THAT([] { ParsePoints("0 0\n", "xyz", "t.xyz"); },
              ThrowsInputError("t.xyz:1: the line ends: expected a number"));
  EXPECT_THAT([] { ParsePoints("x,y,z\n", "txt", "t.txt"); },
              ThrowsInputError("t.txt:1: 'x,y,z': expected a number (x)"));
  EXPECT_THAT(
      [] {
        ParsePoints(FormatNpy(NpyArray::Doubles({3, 2}, {1, 2, 3, 4, 5, 6})),
                    "npy",
                    "t.npy");
      },
      ThrowsInputError("t.npy: array f8 (3, 2): expected shape (N, 3)"));
}

}  // namespace
}  // namespace invsim
