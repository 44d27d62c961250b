// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/body_overlap.h"

#include <gtest/gtest.h>

#include "invsim/base/random.h"
#include "invsim/body/mannequin.h"
#include "invsim/fit/objective.h"
#include "toy_term.h"

namespace invsim {
namespace {

constexpr int kLeftShoulder = 16, kLeftElbow = 18;

Vector3d RandomPoint(Random* random) {
  return Vector3d(random->Normal(), random->Normal(), random->Normal());
}

TEST(NearestOfSegments, IsNearestByBruteForce) {
  Random random(1);
  for (int k = 0; k < 50; ++k) {
    const Vector3d a0 = RandomPoint(&random), a1 = RandomPoint(&random),
                   b0 = RandomPoint(&random), b1 = RandomPoint(&random);
    const auto distance = [&](double s, double t) {
      return ((1 - s) * a0 + s * a1 - (1 - t) * b0 - t * b1).norm();
    };
    const SegmentShares found = NearestOfSegments(a0, a1, b0, b1);
    double least = 1e9;
    for (int i = 0; i <= 100; ++i)
      for (int j = 0; j <= 100; ++j)
        least = std::min(least, distance(0.01 * i, 0.01 * j));
    EXPECT_LE(distance(found.a, found.b), least + 1e-12);
  }
}

TEST(NearestOfSegments, ParallelAndPointLikeSegmentsAreFine) {
  const Vector3d o(0, 0, 0), x(1, 0, 0), y(0, 1, 0);
  const SegmentShares s = NearestOfSegments(o, x, y, x + y);
  EXPECT_NEAR((s.a * x - (y + s.b * x)).norm(), 1, 1e-12);
  const SegmentShares p = NearestOfSegments(o, o, y, x + y);
  EXPECT_NEAR((y + p.b * x).norm(), 1, 1e-12);
}

// The left forearm through the trunk.
BodyParameters ArmThroughTrunk() {
  BodyParameters p;
  p.pose[3 * kLeftShoulder + 2] = -1.2;
  p.pose[3 * kLeftElbow + 2] = -1.6;
  return p;
}

TEST(BodyOverlap, IsNoneInTheTPoseAndDeepThroughTheTrunk) {
  const BodyModel body = Mannequin();
  const BodyOverlap overlap(body);
  EXPECT_GT(overlap.pairs().size(), 20u);
  EXPECT_EQ(overlap.Depths(body.Joints({}), nullptr).maxCoeff(), 0);
  EXPECT_GT(overlap.Depths(body.Joints(ArmThroughTrunk()), nullptr).maxCoeff(),
            0.03);
}

TEST(BodyOverlap, GradientOfTheObjectiveMatchesDifferences) {
  const BodyModel body = Mannequin();
  PriorOptions priors;
  priors.shape = priors.pose = priors.smoothness = 0;
  priors.overlap = 1;
  BodySequence x;
  x.Append(ArmThroughTrunk());
  ToyTerm term(x);  // no gradient here
  Objective objective(priors, {}, &term, &x, body);
  double cost;
  std::vector<double> gradient;
  ASSERT_TRUE(objective.Evaluate(&cost, &gradient));
  EXPECT_GT(cost, 1);
  EXPECT_NEAR(objective.terms().overlap, cost, 1e-9 * cost);
  const auto at = [&](double* unknown, double h) {
    *unknown += h;
    double moved;
    EXPECT_TRUE(objective.Evaluate(&moved, nullptr));
    *unknown -= h;
    return moved;
  };
  double largest = 0;
  for (const double g : gradient) largest = std::max(largest, std::abs(g));
  const double h = 1e-6;
  for (int i = 0; i < kNumShape + kNumPose; ++i) {
    double* unknown = i < kNumShape ? &x.shape[i] : &x.poses[0][i - kNumShape];
    const double difference = (at(unknown, h) - at(unknown, -h)) / (2 * h);
    EXPECT_NEAR(gradient[i], difference, 1e-5 * largest) << i;
  }
}

}  // namespace
}  // namespace invsim
