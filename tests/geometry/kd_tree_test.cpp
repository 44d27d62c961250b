// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/kd_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <utility>

#include "invsim/base/error.h"

namespace invsim {
namespace {

Points RandomPoints(int n, int seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  return Points::NullaryExpr(3, n, [&] { return unit(random); });
}

TEST(KdTree, NearestIsBruteForce) {
  const Points points = RandomPoints(1000, 1), queries = RandomPoints(500, 2);
  const KdTree tree(points);
  const auto all = tree.NearestAll(queries);
  for (int i = 0; i < queries.cols(); ++i) {
    int index;
    const double squared = (points.colwise() - queries.col(i))
                               .colwise()
                               .squaredNorm()
                               .minCoeff(&index);
    EXPECT_EQ(all[i].index, index);
    EXPECT_NEAR(all[i].squared_distance, squared, 1e-15);
    EXPECT_EQ(tree.Nearest(queries.col(i)).index, index);
  }
}

TEST(KdTree, NearestKIsBruteForceSorted) {
  const Points points = RandomPoints(300, 3), queries = RandomPoints(100, 4);
  const KdTree tree(points);
  for (int i = 0; i < queries.cols(); ++i) {
    std::vector<std::pair<double, int>> all;
    for (int j = 0; j < points.cols(); ++j)
      all.emplace_back((points.col(j) - queries.col(i)).squaredNorm(), j);
    std::sort(all.begin(), all.end());
    const auto found = tree.NearestK(queries.col(i), 7);
    ASSERT_EQ(found.size(), 7u);
    for (int k = 0; k < 7; ++k) EXPECT_EQ(found[k].index, all[k].second);
  }
  EXPECT_EQ(tree.NearestK(queries.col(0), 1000).size(), 300u);
}

TEST(KdTree, KeepsItsPointsWhenMoved) {
  KdTree tree(RandomPoints(50, 5));
  const Points points = tree.points();
  const KdTree moved = std::move(tree);
  for (int i = 0; i < points.cols(); ++i)
    EXPECT_EQ(moved.Nearest(points.col(i)).index, i);
}

TEST(KdTree, CoincidentPoints) {
  const KdTree tree(Points::Ones(3, 40));
  EXPECT_EQ(tree.Nearest(Vector3d::Zero()).squared_distance, 3.0);
  EXPECT_EQ(tree.NearestK(Vector3d::Zero(), 40).size(), 40u);
}

TEST(KdTree, RefusesUnusablePoints) {
  EXPECT_THROW(KdTree(Points(3, 0)), InputError);
  Points points = RandomPoints(4, 6);
  points(1, 2) = std::numeric_limits<double>::infinity();
  EXPECT_THROW(KdTree{points}, InputError);
}

}  // namespace
}  // namespace invsim
