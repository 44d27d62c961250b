// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/point_filters.h"

#include <gtest/gtest.h>

#include "invsim/base/error.h"
#include "invsim/base/random.h"

namespace invsim {
namespace {

// A ball of points 1 km from the origin, where a float is good to 0.06 mm.
Points DistantBall(int count) {
  Random random(7);
  Points points(3, count);
  for (int i = 0; i < count; ++i) {
    Vector3d p(random.Normal(), random.Normal(), random.Normal());
    points.col(i) = Vector3d(1000, 0, -1000) +
                    0.1 * std::cbrt(random.Uniform()) * p.normalized();
  }
  return points;
}

TEST(PointFiltersTest, AreOffByDefault) {
  const Points points = DistantBall(50);
  EXPECT_EQ(FilterPoints({}, points), points);
}

TEST(PointFiltersTest, VoxelsHoldTheMeanOfTheirPoints) {
  // Two tight pairs far apart in voxels of 1 cm, 1 km from the origin.
  const Vector3d far(1000, 0, -1000);
  const Vector3d shift(1e-5, 0, 0);
  Points points(3, 4);
  points << far - Vector3d(0.1234, 0, 0), far - Vector3d(0.1234, 0, 0) + shift,
      far + Vector3d(0.1234, 0, 0) - shift, far + Vector3d(0.1234, 0, 0);
  const Points thinned = FilterPoints({.voxel = 0.01}, points);
  ASSERT_EQ(thinned.cols(), 2);
  EXPECT_NEAR(
      (thinned.col(0) - 0.5 * (points.col(0) + points.col(1))).norm(), 0, 1e-8);
  EXPECT_NEAR(
      (thinned.col(1) - 0.5 * (points.col(2) + points.col(3))).norm(), 0, 1e-8);
}

TEST(PointFiltersTest, VoxelsThinEvenly) {
  const Points points = DistantBall(20000);
  const Points thinned = FilterPoints({.voxel = 0.02}, points);
  // Volume of the ball in voxels: 524; those cut by its surface add to it.
  EXPECT_GT(thinned.cols(), 500);
  EXPECT_LT(thinned.cols(), 1100);
  EXPECT_EQ(FilterPoints({.voxel = 0.02}, points), thinned);
  // The grid starts at the centroid: one mean per octant.
  EXPECT_EQ(FilterPoints({.voxel = 10}, points).cols(), 8);
}

TEST(PointFiltersTest, OutliersGoAndTheRestStaysToTheLastBit) {
  Points points = DistantBall(500);
  points.col(100) += Vector3d(0.5, 0, 0);
  points.col(300) += Vector3d(0, -0.4, 0);
  const Points cleaned =
      FilterPoints({.outlier_neighbours = 10, .outlier_deviations = 4}, points);
  ASSERT_EQ(cleaned.cols(), 498);
  EXPECT_EQ(cleaned.leftCols(100), points.leftCols(100));
  EXPECT_EQ(cleaned.middleCols(100, 199), points.middleCols(101, 199));
  EXPECT_EQ(cleaned.rightCols(199), points.rightCols(199));
}

TEST(PointFiltersTest, RefusesVoxelsWithoutNumber) {
  EXPECT_THROW(FilterPoints({.voxel = 1e-5}, DistantBall(100)), UsageError);
}

TEST(PointFiltersTest, KeepsCloudsOfFewPoints) {
  const Points points = DistantBall(5);
  EXPECT_EQ(FilterPoints({.outlier_neighbours = 10}, points), points);
  EXPECT_EQ(
      FilterPoints({.voxel = 1, .outlier_neighbours = 2}, Points(3, 0)).cols(),
      0);
}

TEST(PointFiltersTest, DescribesItsOptions) {
  PointFilterOptions options;
  OptionTable table;
  table.AddSection("points", &options);
  Config config;
  config.Assign("points.voxel=0.005", "--set");
  table.Read(config);
  EXPECT_EQ(options.voxel, 0.005);
  config.Assign("points.voxel=-1", "--set");
  EXPECT_THROW(table.Read(config), UsageError);
}

TEST(WithoutStrays, KeepsAllButWhatIsFarOutside) {
  // A person-sized box and, of 500 points, four metres away.
  Points points = Points::Random(3, 500);
  points.row(0) *= 0.4;
  points.row(2) *= 0.2;
  EXPECT_EQ(WithoutStrays(points), points);
  for (int k = 0; k < 4; ++k) points.col(100 * k).setConstant(k - 20);
  const Points rest = WithoutStrays(points);
  EXPECT_EQ(rest.cols(), 496);
  EXPECT_LE(rest.cwiseAbs().maxCoeff(), 1);
  EXPECT_EQ(rest.col(0), points.col(1));
  EXPECT_EQ(WithoutStrays(Points(3, 0)).cols(), 0);
  EXPECT_EQ(WithoutStrays(Points::Ones(3, 1)).cols(), 1);
}

}  // namespace
}  // namespace invsim
