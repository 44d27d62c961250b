// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/element_pair.h"

#include <gtest/gtest.h>

#include <random>

namespace invsim {
namespace {

PairPoints RandomPair(std::mt19937* random) {
  std::normal_distribution<double> normal;
  return PairPoints::NullaryExpr([&] { return normal(*random); });
}

// Against a grid over both elements.
TEST(ElementPair, NearestPointsAreNearerThanAllOthers) {
  std::mt19937 random(4);
  for (const PairKind kind : {PairKind::kVertexFace, PairKind::kEdgeEdge}) {
    for (int trial = 0; trial < 50; ++trial) {
      const PairPoints x = RandomPair(&random);
      const NearestPoints nearest = Nearest(kind, x);
      EXPECT_NEAR(nearest.weights.sum(), 0, 1e-12);
      EXPECT_LT((x * nearest.weights - nearest.offset).norm(), 1e-12);
      const int n = 40;
      double best = 1e9;
      for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= n; ++j) {
          const double s = static_cast<double>(i) / n;
          const double t = static_cast<double>(j) / n;
          if (kind == PairKind::kVertexFace && s + t > 1) continue;
          const Eigen::Vector4d w = kind == PairKind::kVertexFace
                                        ? Eigen::Vector4d(1, s + t - 1, -s, -t)
                                        : Eigen::Vector4d(1 - s, s, t - 1, -t);
          best = std::min(best, (x * w).norm());
        }
      }
      EXPECT_LE(nearest.distance, best + 1e-12);
      EXPECT_GT(nearest.distance, best - 0.1);
    }
  }
}

TEST(ElementPair, ParallelAndCollinearEdges) {
  PairPoints x;
  x << 0, 1, 0.5, 2,  //
      0, 0, 0.3, 0.3, 0, 0, 0, 0;
  EXPECT_NEAR(Nearest(PairKind::kEdgeEdge, x).distance, 0.3, 1e-15);
  x << 0, 1, 3, 2, 0, 0, 0, 0, 0, 0, 0, 0;
  EXPECT_NEAR(Nearest(PairKind::kEdgeEdge, x).distance, 1, 1e-15);
  x.col(1) = x.col(0);  // an edge of no length
  EXPECT_NEAR(Nearest(PairKind::kEdgeEdge, x).distance, 2, 1e-15);
}

// A vertex falls through a face, and two edges through each other, in steps
// many times as long as their distance.
TEST(ElementPair, TimeOfPassingThrough) {
  PairPoints x0;
  x0 << 0.2, 0, 1, 0,  //
      1, 0, 0, 0,      //
      0.2, 0, 0, 1;
  PairPoints x1 = x0;
  x1.col(0) -= Vector3d(0, 100, 0);
  const double gap = 1e-3;
  const double t = FirstTimeWithin(gap, PairKind::kVertexFace, x0, x1);
  EXPECT_LE(t, (1 - gap) / 100);
  EXPECT_GT(t, (1 - 1.2 * gap) / 100);
  x0 << -1, 1, 0, 0,  //
      0.5, 0.5, 0, 0, 0, 0, -1, 1;
  x1 = x0;
  x1.leftCols<2>().row(1).setConstant(-4.5);
  EXPECT_NEAR(
      FirstTimeWithin(gap, PairKind::kEdgeEdge, x0, x1), (0.5 - gap) / 5, 1e-4);
  // Together they do not meet, nor if they part.
  x1 = x0.colwise() + Vector3d(0, -5, 0);
  EXPECT_EQ(FirstTimeWithin(gap, PairKind::kEdgeEdge, x0, x1), kNever);
  x1 = x0;
  x1.leftCols<2>().row(1).setConstant(9);
  EXPECT_EQ(FirstTimeWithin(gap, PairKind::kEdgeEdge, x0, x1), kNever);
}

// Sampled in time, no pair said to stay apart comes near, and a pair said to
// meet does come within reach of the gap at that time.
TEST(ElementPair, NeverLateOnRandomMoves) {
  std::mt19937 random(9);
  int met = 0, passed = 0;
  for (const PairKind kind : {PairKind::kVertexFace, PairKind::kEdgeEdge}) {
    for (int trial = 0; trial < 400; ++trial) {
      const PairPoints x0 = RandomPair(&random), x1 = RandomPair(&random);
      const double gap = 0.01 * Nearest(kind, x0).distance;
      const double t = FirstTimeWithin(gap, kind, x0, x1);
      const double last = std::min(t, 1.0);
      for (int k = 0; k <= 100; ++k)
        EXPECT_GE(Nearest(kind, x0 + 0.01 * k * last * (x1 - x0)).distance,
                  0.999 * gap);
      if (t == kNever) {
        ++passed;
      } else {
        ++met;
        EXPECT_LE(Nearest(kind, x0 + t * (x1 - x0)).distance, 1.001 * gap);
      }
    }
  }
  EXPECT_GT(met, 20);
  EXPECT_GT(passed, 20);
}

}  // namespace
}  // namespace invsim
