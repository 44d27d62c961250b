// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/box_overlap.h"

#include <gtest/gtest.h>

#include <random>

namespace invsim {
namespace {

std::vector<std::array<int, 2>> EveryPair(const Points& low,
                                          const Points& high) {
  std::vector<std::array<int, 2>> pairs;
  for (int i = 0; i < low.cols(); ++i)
    for (int j = i + 1; j < low.cols(); ++j)
      if ((low.col(i).array() <= high.col(j).array()).all() &&
          (low.col(j).array() <= high.col(i).array()).all())
        pairs.push_back({i, j});
  return pairs;
}

TEST(OverlappingBoxes, AreThoseOfTestingEveryPair) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform;
  // Near the origin, and where single precision is coarser than the boxes.
  for (const double away : {0.0, 1e4}) {
    const int n = 800;
    Points low(3, n), high(3, n);
    for (int i = 0; i < n; ++i) {
      for (int c = 0; c < 3; ++c) {
        low(c, i) = away + uniform(random);
        high(c, i) = low(c, i) + 0.1 * uniform(random);
      }
    }
    const auto pairs = OverlappingBoxes(low, high);
    EXPECT_GT(pairs.size(), 100u);
    EXPECT_EQ(pairs, EveryPair(low, high));
  }
}

TEST(OverlappingBoxes, TouchingAndEmptyBoxesCount) {
  Points low(3, 4), high(3, 4);
  low << 0, 1, 0.5, 3, 0, 0, 0.5, 0, 0, 0, 0.5, 0;
  high << 1, 2, 0.5, 4, 1, 1, 0.5, 1, 1, 1, 0.5, 1;
  const std::vector<std::array<int, 2>> expected = {{0, 1}, {0, 2}};
  EXPECT_EQ(OverlappingBoxes(low, high), expected);
  EXPECT_TRUE(OverlappingBoxes(low.leftCols(1), high.leftCols(1)).empty());
}

TEST(OverlappingBoxes, EqualBoxesAllMeet) {
  const int n = 40;
  const Points low = Points::Zero(3, n), high = Points::Ones(3, n);
  EXPECT_EQ(OverlappingBoxes(low, high).size(), n * (n - 1) / 2u);
}

}  // namespace
}  // namespace invsim
