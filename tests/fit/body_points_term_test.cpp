// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/body_points_term.h"

#include <gtest/gtest.h>

#include "dressed_mannequin.h"
#include "invsim/fit/coverage.h"

namespace invsim {
namespace {

class BodyPoints : public ::testing::Test {
 protected:
  BodyPoints() : person_(0.03), body_(person_.body()) {
    const Garment garment = person_.MakeGarment();
    const Points& skin = body_.data().v_template;
    covered_ = CoveredVertices(skin,
                               VertexNormals(skin, body_.faces()),
                               SurfaceIndex(garment.placed, garment.faces));
  }

  double Cost(const BodyParameters& p,
              const std::vector<Points>& clouds,
              std::vector<FrameBlock>* blocks = nullptr) {
    BodyPointsTerm term(body_, covered_, clouds, options_, 1);
    BodySequence x;
    x.shape = p.shape;
    for (size_t t = 0; t < clouds.size(); ++t) x.Append(p);
    std::vector<double> costs;
    EXPECT_EQ(term.Evaluate(x, kNoLimit, &costs), Evaluation::kDone);
    if (blocks) {
      EXPECT_TRUE(term.Linearize(blocks));
    }
    double sum = 0;
    for (const double cost : costs) sum += cost;
    return sum;
  }

  DressedMannequin person_;
  const BodyModel& body_;
  std::vector<bool> covered_;
  BodyPointsOptions options_;
};

class Gradient : public BodyPoints,
                 public ::testing::WithParamInterface<bool> {};

// All skin bare, or all of it hidden: between them the derivative leaves out
// that the share of belief changes with the place on the skin.
TEST_P(Gradient, MatchesDifferences) {
  covered_.assign(covered_.size(), GetParam());
  const std::vector<Points> clouds = {person_.Scan({}, 400, 1)};
  BodyParameters p;
  p.shape[0] = 0.3;
  p.pose.setConstant(0.05);
  p.translation = Vector3d(0.02, -0.01, 0.03);
  std::vector<FrameBlock> blocks;
  const double cost = Cost(p, clouds, &blocks);
  EXPECT_NEAR(blocks[0].cost, cost, 1e-12 * cost);
  const VectorXd gradient = blocks[0].jacobian.transpose() * blocks[0].residual;
  VectorXd differences(kNumBodyParameters);
  for (int i = 0; i < kNumBodyParameters; ++i) {
    double side[2];
    for (const int s : {0, 1}) {
      BodyParameters q = p;
      const double h = s ? 1e-6 : -1e-6;
      if (i < kNumShape)
        q.shape[i] += h;
      else if (i < kNumShape + kNumPose)
        q.pose[i - kNumShape] += h;
      else
        q.translation[i - kNumShape - kNumPose] += h;
      side[s] = Cost(q, clouds);
    }
    differences[i] = (side[1] - side[0]) / 2e-6;
  }
  EXPECT_LT((gradient - differences).norm(), 1e-3 * differences.norm());
}

INSTANTIATE_TEST_SUITE_P(BareOrHidden, Gradient, ::testing::Bool());

// A body blown up into the garment must cost more than the true one.
TEST_F(BodyPoints, ClothDoesNotInflateTheBody) {
  const std::vector<Points> clouds = {person_.Scan({}, 1500, 1)};
  BodyParameters fat;
  fat.shape[1] = 2;  // all girths
  EXPECT_GT(Cost(fat, clouds), 1.2 * Cost({}, clouds));
}

TEST_F(BodyPoints, FarPointsHardlyCount) {
  Points cloud = person_.Scan({}, 500, 1);
  const double clean = Cost({}, {cloud});
  cloud.col(0) += Vector3d(0, 0, 3);
  const double one = Cost({}, {cloud});
  cloud.col(0) += Vector3d(0, 0, 30);
  EXPECT_LT(Cost({}, {cloud}) - clean, 2 * (one - clean) + 1e-9);
}

}  // namespace
}  // namespace invsim
