// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/cloth_points_term.h"

#include <ceres/problem.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "dressed_mannequin.h"
#include "invsim/base/random.h"
#include "invsim/cloth/named_materials.h"
#include "invsim/fit/objective.h"
#include "invsim/sim/relaxation.h"
#include "invsim/sim/scene.h"

namespace invsim {
namespace {

constexpr int kFrames = 3;

// A tube of cloth on the trunk of a mannequin that leans and shifts.
class ClothPoints : public ::testing::Test {
 protected:
  ClothPoints() : person_(0.01), garment_(person_.MakeGarment()) {
    scene_.step.substeps = 1;
    // Differences of 1e-6 are to see the cloth move, not the solver stop.
    scene_.step.friction.tolerance = 1e-8;
    const Material material = FindMaterial(scene_.material);
    simulator_ = std::make_unique<Simulator>(
        MakeSetup(scene_, person_.body(), garment_, material));
    for (int t = 0; t < kFrames; ++t) {
      BodyParameters p;
      p.pose[3 * 3] = 0.02 * t;  // bends forward
      p.translation = Vector3d(0.004 * t, 0, 0.003 * t);
      truth_.Append(p);
      clouds_.push_back(person_.Scan(p, 300, t));
    }
    reference_.body = person_.body().Vertices({});
    reference_.cloth.x = garment_.placed;
    reference_.cloth.v = Points::Zero(3, garment_.num_vertices());
    options_.lead.lead_frames = 1;
    options_.lead.hold_frames = 0;
    // No nearest point may change within a difference.
    options_.points_to_surface = 0;
    options_.loss = {"trivial", 1};
    // Not the minimum, where there is no gradient to compare.
    start_ = truth_;
    start_.shape[0] = 0.1;
    for (Vector3d& t : start_.translations) t += Vector3d(0.01, 0, -0.01);
  }

  ClothPointsTerm MakeTerm(int frames) {
    return ClothPointsTerm(person_.body(),
                           simulator_.get(),
                           garment_.faces,
                           VertexAreas(garment_),
                           {clouds_.begin(), clouds_.begin() + frames},
                           30,
                           reference_,
                           options_);
  }

  static BodySequence First(BodySequence x, int frames) {
    x.poses.resize(frames);
    x.translations.resize(frames);
    return x;
  }

  // Sum of the frames' costs at x moved by h u in the shape and in pose and
  // translation of the frames from `from` on.
  double CostAlong(BodySequence x,
                   const VectorXd& u,
                   int from,
                   double h,
                   ClothPointsTerm* term) {
    x.shape += h * u.head<kNumShape>();
    for (int t = from; t < x.num_frames(); ++t) {
      x.poses[t] += h * u.segment<kNumPose>(kNumShape);
      x.translations[t] += h * u.tail<3>();
    }
    std::vector<double> costs;
    EXPECT_EQ(term->Evaluate(x, kNoLimit, &costs), Evaluation::kDone);
    double sum = 0;
    for (const double cost : costs) sum += cost;
    return sum;
  }

  // Slope of the cost along u by the blocks and by differences: shape in all
  // frames, the rest in frames from `from` on.
  void CompareSlopes(const VectorXd& u, int frames, int from) {
    ClothPointsTerm term = MakeTerm(frames);
    const BodySequence x = First(start_, frames);
    CostAlong(x, u, from, 0, &term);
    std::vector<FrameBlock> blocks;
    ASSERT_TRUE(term.Linearize(&blocks));
    VectorXd shape_only = u;
    shape_only.tail(kNumPose + 3).setZero();
    double slope = 0;
    for (int t = 0; t < frames; ++t)
      slope += (blocks[t].jacobian.transpose() * blocks[t].residual)
                   .dot(t < from ? shape_only : u);
    // The cost jumps where skin comes into view or a contact switches, and such
    // a place may lie within a step.
    double difference = std::numeric_limits<double>::infinity();
    for (const double h : {1e-6, 1e-7, 1e-8}) {
      const double d =
          (CostAlong(x, u, from, h, &term) - CostAlong(x, u, from, -h, &term)) /
          (2 * h);
      if (std::abs(d - slope) < std::abs(difference - slope)) difference = d;
    }
    EXPECT_NEAR(slope, difference, 2e-3 * std::abs(difference));
    EXPECT_GT(std::abs(difference), 1);
  }

  static VectorXd Direction(bool shape, bool pose, bool translation) {
    Random random(5);
    VectorXd u(kNumBodyParameters);
    for (double& value : u) value = random.Normal();
    if (!shape) u.head<kNumShape>().setZero();
    u.segment<kNumPose>(kNumShape) *= pose ? 0.1 : 0;
    u.tail<3>() *= translation ? 0.1 : 0;
    return u;
  }

  DressedMannequin person_;
  Garment garment_;
  SceneOptions scene_;
  std::unique_ptr<Simulator> simulator_;
  BodySequence truth_, start_;
  std::vector<Points> clouds_;
  ClothReference reference_;
  ClothPointsOptions options_;
};

// Of the last frame's own pose the paper's derivative misses nothing.
TEST_F(ClothPoints, OneFrameIsExactInTheLastFrame) {
  CompareSlopes(Direction(false, true, false), kFrames, kFrames - 1);
  CompareSlopes(Direction(false, false, true), kFrames, kFrames - 1);
}

TEST_F(ClothPoints, OneFrameIsExactForASingleFrame) {
  CompareSlopes(Direction(true, true, true), 1, 0);
}

TEST_F(ClothPoints, OneFrameIsExactWithDistancesToPoints) {
  options_.distance = VertexDistance::kPoint;
  CompareSlopes(Direction(true, true, true), 1, 0);
}

// The plane's distance is never more than the point's.
TEST_F(ClothPoints, DistancesToPlanesCostLess) {
  std::vector<double> to_points, to_planes;
  options_.distance = VertexDistance::kPoint;
  MakeTerm(1).Evaluate(First(start_, 1), kNoLimit, &to_points);
  options_.distance = VertexDistance::kPlane;
  MakeTerm(1).Evaluate(First(start_, 1), kNoLimit, &to_planes);
  EXPECT_LT(to_planes[0], to_points[0]);
  EXPECT_GT(to_planes[0], 0);
}

// The shape moves the cloth of all frames, and so does a lasting change of
// pose and place.
TEST_F(ClothPoints, CarriedIsExactForTheShapeAndLastingChanges) {
  options_.history = History::kCarried;
  options_.lead.hold_frames = 1;
  CompareSlopes(Direction(true, false, false), kFrames, 0);
  CompareSlopes(Direction(true, true, true), kFrames, 0);
}

// Everything a fit minimises, block by block. A frame's own block misses
// nothing of the priors and of this frame's points (later frames' are what a
// history of one frame leaves out); the shape's, carried, nothing at all.
TEST_F(ClothPoints, WholeObjectiveMatchesDifferencesInEveryBlock) {
  PriorOptions priors;
  priors.overlap = 1;
  Random random(7);
  for (const History history : {History::kCarried, History::kOneFrame}) {
    options_.history = history;
    options_.lead.hold_frames = history == History::kCarried ? 1 : 0;
    ClothPointsTerm term = MakeTerm(kFrames);
    BodySequence x = start_;
    Objective objective(priors, {}, &term, &x, person_.body());
    double unused = 0;
    std::vector<double> gradient;
    ASSERT_TRUE(objective.Evaluate(&unused, &gradient));
    // The priors, and the points of frame t or of all.
    const auto cost = [&](int t) {
      EXPECT_TRUE(objective.Evaluate(&unused, nullptr));
      const CostTerms terms = objective.terms();
      if (t < 0) return terms.total();
      std::vector<double> costs;
      EXPECT_EQ(term.Evaluate(x, kNoLimit, &costs), Evaluation::kDone);
      return terms.total() - terms.data + costs[t];
    };
    size_t at = 0;
    const std::vector<double*> blocks = objective.blocks();
    for (size_t k = 0; k < blocks.size(); ++k) {
      const int size = objective.problem()->ParameterBlockSize(blocks[k]);
      const int frame = k == 0 ? -1 : static_cast<int>(k - 1) / 2;
      Eigen::Map<VectorXd> block(blocks[k], size);
      const VectorXd kept = block;
      VectorXd u(size);
      for (double& value : u) value = random.Normal();
      const double slope =
          u.dot(Eigen::Map<const VectorXd>(gradient.data() + at, size));
      at += size;
      if ((history == History::kCarried) != (k == 0)) continue;
      // Which skin is bare and which face is touched change by jumps: on one
      // side at least there is none.
      const double h = 1e-7, here = cost(frame);
      block = kept + h * u;
      const double up = (cost(frame) - here) / h;
      block = kept - h * u;
      const double down = (here - cost(frame)) / h;
      block = kept;
      const double difference =
          std::abs(up - slope) < std::abs(down - slope) ? up : down;
      EXPECT_NEAR(slope, difference, 2e-3 * std::abs(difference) + 0.05)
          << "block " << k;
      EXPECT_GT(std::abs(difference), 1) << "block " << k;
    }
    EXPECT_EQ(at, gradient.size());
  }
}

TEST_F(ClothPoints, GivesUpAboveTheLimit) {
  ClothPointsTerm term = MakeTerm(kFrames);
  std::vector<double> costs;
  EXPECT_EQ(term.Evaluate(start_, 1e-9, &costs), Evaluation::kAbandoned);
  EXPECT_EQ(term.Evaluate(start_, kNoLimit, &costs), Evaluation::kDone);
}

TEST_F(ClothPoints, StopsBetweenFrames) {
  ClothPointsTerm term = MakeTerm(kFrames);
  int asked = 0;
  term.set_stop([&] { return ++asked > 1; });
  std::vector<double> costs;
  EXPECT_EQ(term.Evaluate(start_, kNoLimit, &costs), Evaluation::kStopped);
  EXPECT_EQ(asked, 2);
  EXPECT_GT(costs[0], 0);
  EXPECT_EQ(costs[1], 0);
  term.set_stop({});
  EXPECT_EQ(term.Evaluate(start_, kNoLimit, &costs), Evaluation::kDone);
}

// The same point twice is the same cost, whatever was evaluated in between.
TEST_F(ClothPoints, DependsOnThePointAlone) {
  ClothPointsTerm term = MakeTerm(kFrames);
  const VectorXd u = Direction(true, true, true);
  const double before = CostAlong(start_, u, 0, 0, &term);
  CostAlong(start_, u, 0, 0.1, &term);
  EXPECT_EQ(CostAlong(start_, u, 0, 0, &term), before);
}

TEST_F(ClothPoints, FailsWhereTheBodyIsNotFinite) {
  for (const int frame : {0, 1}) {
    ClothPointsTerm term = MakeTerm(kFrames);
    BodySequence x = start_;
    x.translations[frame][0] = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> costs;
    EXPECT_EQ(term.Evaluate(x, kNoLimit, &costs), Evaluation::kFailed);
  }
}

}  // namespace
}  // namespace invsim
