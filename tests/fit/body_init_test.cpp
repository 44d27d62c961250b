// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/body_init.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>

#include "dressed_mannequin.h"
#include "invsim/body/rotation.h"
#include "sim/test_scene.h"

namespace invsim {
namespace {

// Walks through the room with lowered arms, facing away from +z.
BodyParameters TruthAt(int t) {
  BodyParameters p;
  p.shape[0] = 1;
  p.shape[1] = -1;
  const double swing = 0.1 * t;
  p.pose.head<3>() = Vector3d(0, 2.4 + 0.02 * t, 0);
  p.pose[3 * 1] = -0.2 + swing;      // left hip
  p.pose[3 * 2] = 0.2 - swing;       // right hip
  p.pose[3 * 4] = 0.5;               // left knee
  p.pose[3 * 16 + 2] = -1.1;         // left shoulder
  p.pose[3 * 17 + 2] = 1.0 - swing;  // right shoulder
  p.pose[3 * 18 + 1] = -0.6;         // left elbow
  p.translation = Vector3d(2, 0.8, -3 + 0.03 * t);
  return p;
}

double MeanVertexError(const BodyModel& body,
                       const BodyParameters& a,
                       const BodyParameters& b) {
  return (body.Vertices(a) - body.Vertices(b)).colwise().norm().mean();
}

class Init : public ::testing::Test {
 protected:
  static constexpr int kFrames = 4;

  Init() : person_(0.02), garment_(person_.MakeGarment()) {
    options_.anchors = 1;
    options_.headings = 6;
    options_.fine_points = 1500;
    options_.filter = 0;
    for (int t = 0; t < kFrames; ++t)
      clouds_.push_back(person_.Scan(TruthAt(t), 3000, t));
  }

  BodyInit Run() {
    return InitializeBody(person_.body(), garment_, clouds_, options_, 1, {});
  }

  DressedMannequin person_;
  Garment garment_;
  std::vector<Points> clouds_;
  BodyInitOptions options_;
};

TEST_F(Init, FindsABodyItWasNotToldTheHeadingOf) {
  const BodyInit init = Run();
  EXPECT_TRUE(init.complete);
  ASSERT_EQ(init.body.num_frames(), kFrames);
  for (int t = 0; t < kFrames; ++t)
    EXPECT_LT(MeanVertexError(person_.body(), init.body.Frame(t), TruthAt(t)),
              0.015)
        << "frame " << t;
  // The garment is 2 cm off the trunk; the body under it is not.
  BodyParameters found{init.body.shape, PoseVector::Zero(), Vector3d::Zero()};
  BodyParameters truth{TruthAt(0).shape, PoseVector::Zero(), Vector3d::Zero()};
  EXPECT_LT(MeanVertexError(person_.body(), found, truth), 0.012);
}

// Forearms across the chest: without starts of single limbs both arms fit the
// points of one, and the body is 113 mm off.
TEST_F(Init, FindsArmsThatAreFolded) {
  BodyParameters truth = TruthAt(0);
  truth.pose.segment<3>(3 * 16) = Vector3d(0.65, -0.88, -1.26);
  truth.pose.segment<3>(3 * 17) = Vector3d(0.7, 1.1, 1.26);
  truth.pose.segment<3>(3 * 18) = Vector3d(0, -1.77, 0.66);
  truth.pose.segment<3>(3 * 19) = Vector3d(0, 1.32, -0.66);
  clouds_ = {person_.Scan(truth, 3000, 0)};
  EXPECT_LT(MeanVertexError(person_.body(), Run().body.Frame(0), truth), 0.02);
}

TEST_F(Init, IsTheSameForTheSameSeed) {
  clouds_.resize(1);
  options_.headings = 1;
  options_.iterations = 3;
  const BodyInit a = Run(), b = Run();
  EXPECT_EQ(a.body.shape, b.body.shape);
  EXPECT_EQ(a.body.poses[0], b.body.poses[0]);
}

// Points of a left forearm in the trunk.
TEST_F(Init, PartsOfTheBodyAreMovedOutOfEachOther) {
  BodyParameters truth;
  truth.pose[3 * 16 + 2] = -1.2;
  truth.pose[3 * 18 + 2] = -1.6;
  clouds_ = {person_.Scan(truth, 3000, 0)};
  options_.headings = 1;
  options_.coarse_points = options_.fine_points = 150;
  options_.iterations = 3;
  const auto overlap = [&](double weight) {
    options_.priors.overlap = weight;
    return Run().refinement.iterations.back().terms.overlap / weight;
  };
  const double light = overlap(1e-3);
  EXPECT_GT(light, 0);
  EXPECT_LT(overlap(100), 0.5 * light);
}

TEST_F(Init, RefusesAWrongUnitAndNoFrames) {
  for (Points& cloud : clouds_) cloud *= 1000;  // millimetres
  try {
    Run();
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("unit"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("frame 0"), std::string::npos);
  }
  clouds_.clear();
  EXPECT_THROW(Run(), InputError);
}

TEST_F(Init, RefusesAnEmptyFrame) {
  clouds_[2].resize(3, 0);
  EXPECT_THROW(Run(), InputError);
}

TEST_F(Init, StopsWhenAsked) {
  options_.headings = 1;
  std::vector<std::string> done;
  const BodyInit init = InitializeBody(person_.body(),
                                       garment_,
                                       clouds_,
                                       options_,
                                       1,
                                       [&](const std::string& what) {
                                         done.push_back(what);
                                         return false;
                                       });
  EXPECT_THAT(done, ::testing::ElementsAre("searched frame 2"));
  EXPECT_FALSE(init.complete);
  EXPECT_EQ(init.body.num_frames(), kFrames);
}

// Within the optimisation of a frame, and nothing is begun after that.
TEST_F(Init, StopsInTheMiddleOfAFrame) {
  int asked = 0;
  const BodyInit init =
      InitializeBody(person_.body(), garment_, clouds_, options_, 1, {}, [&] {
        return ++asked > 3;
      });
  EXPECT_EQ(asked, 4);
  EXPECT_FALSE(init.complete);
  EXPECT_EQ(init.body.num_frames(), kFrames);
  const InterruptedTest guard;
  std::raise(SIGINT);
  EXPECT_FALSE(Run().complete);
}

}  // namespace
}  // namespace invsim
