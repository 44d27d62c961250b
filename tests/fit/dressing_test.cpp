// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/dressing.h"

#include <gtest/gtest.h>

#include <csignal>

#include "invsim/cloth/carry.h"
#include "invsim/sim/scene.h"
#include "sim/test_scene.h"

namespace invsim {
namespace {

// A sheet made for a ball is put on a bigger one.
class DressingTest : public ::testing::Test {
 protected:
  DressingTest()
      : body_(BallBody()), garment_(SheetAboveBall(6, 0.2)), motion_(1) {
    motion_[0].shape[0] = 3;  // its radius is 1.3 times as long
    options_.settle_seconds = 0.1;
    options_.move_seconds = 0.2;
    options_.hold_seconds = 0.2;
    SceneOptions scene;
    simulator_ = std::make_unique<Simulator>(
        MakeSetup(scene, body_, garment_, PlainCloth()));
  }

  Dressing DressBy(const DressingCost& cost, const StopPredicate& stop = {}) {
    return Dress({body_, garment_, motion_, 30},
                 options_,
                 simulator_.get(),
                 cost,
                 {},
                 stop);
  }
  // Put on as a person did of whom all that is known are the points.
  Points Worn(bool carried) {
    Garment garment = garment_;
    RelaxationScene scene = {body_, garment, motion_, 30};
    if (carried) {
      garment = CarryGarment(garment_,
                             body_.Vertices({}),
                             body_.Vertices(motion_[0]),
                             body_.faces(),
                             "sheet");
      scene.garment_shape = motion_[0].shape;
    }
    return Relax(scene, options_, simulator_.get()).cloth.x;
  }

  BodyModel body_;
  Garment garment_;
  std::vector<BodyParameters> motion_;
  RelaxationOptions options_;
  std::unique_ptr<Simulator> simulator_;
};

TEST_F(DressingTest, IsThatOfTheClothMeasured) {
  const Points cloth[] = {Worn(true), Worn(false)};
  // A sheet on top of a ball remembers little.
  EXPECT_GT((cloth[0] - cloth[1]).colwise().norm().maxCoeff(), 1e-5);
  for (const int way : {0, 1}) {
    const Dressing dressing = DressBy([&](const ClothReference& reference) {
      return (reference.cloth.x - cloth[way]).norm();
    });
    ASSERT_EQ(dressing.tries.size(), 2u);
    EXPECT_EQ(dressing.worn, way);
    EXPECT_EQ(dressing.tries[way].cost, 0);
    EXPECT_GT(dressing.tries[1 - way].cost, 1e-5);
    EXPECT_EQ(dressing.reference->cloth.x, cloth[way]);
    EXPECT_EQ(dressing.reference->body, body_.Vertices(motion_[0]));
  }
}

TEST_F(DressingTest, GrowsIntoAShapeToWhichTheGarmentCannotBeCarried) {
  // Two sheets that cross: nothing a place can be found for.
  garment_.placed.col(0) = -garment_.placed.col(0);
  const Dressing dressing = DressBy([](const ClothReference&) { return 1.0; });
  ASSERT_EQ(dressing.tries.size(), 2u);
  EXPECT_FALSE(dressing.tries[0].refused.empty());
  EXPECT_FALSE(dressing.tries[0].relaxation);
  EXPECT_EQ(dressing.tries[1].way, DressingWay::kGrown);
  EXPECT_EQ(dressing.worn, 1);
}

// Cloth from which the sequence cannot be simulated is not worn if another is
// there, but is better than none.
TEST_F(DressingTest, TakesWhatCanGoOn) {
  int calls = 0;
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(DressBy([&](const ClothReference&) {
              return calls++ == 0 ? infinite : 5.0;
            }).worn,
            1);
  EXPECT_EQ(DressBy([&](const ClothReference&) { return infinite; }).worn, 0);
}

TEST_F(DressingTest, OfTheShapeTheGarmentWasMadeForIsTriedOnce) {
  motion_[0].shape.setZero();
  const Dressing dressing = DressBy([](const ClothReference&) { return 1.0; });
  EXPECT_EQ(dressing.tries.size(), 1u);
  EXPECT_EQ(dressing.worn, 0);
}

// It ends with what is worn by then: nothing, or the one way, be it judged or
// not.
TEST_F(DressingTest, EndsWithWhatIsWornWhenAskedToStop) {
  const Dressing nothing =
      DressBy([](const ClothReference&) { return 1.0; }, [] { return true; });
  EXPECT_TRUE(nothing.cut_short);
  EXPECT_FALSE(nothing.reference);
  for (const int judged : {1, 2}) {
    int seen = 0;
    const Dressing one = DressBy(
        [&](const ClothReference&) {
          ++seen;
          return 1.0 / seen;  // the other way looks better
        },
        [&] { return seen == judged; });
    EXPECT_TRUE(one.cut_short);
    EXPECT_EQ(one.worn, 0);
    EXPECT_TRUE(one.reference);
  }
  // In the middle of the other way.
  int seen = 0, frames = 0;
  const Dressing one =
      DressBy([&](const ClothReference&) { return 1.0 / ++seen; },
              [&] { return seen == 1 && ++frames > 3; });
  EXPECT_EQ(one.tries.size(), 2u);
  EXPECT_EQ(one.worn, 0);
  EXPECT_TRUE(one.cut_short);
  EXPECT_FALSE(DressBy([](const ClothReference&) { return 1.0; }).cut_short);
}

// While the one way is judged or the other: nothing is worn by half a
// judgement.
TEST_F(DressingTest, StopsWhenInterrupted) {
  for (const int stopped : {0, 1}) {
    const InterruptedTest guard;
    int judged = 0;
    const Dressing dressing = DressBy([&](const ClothReference&) {
      if (judged++ == stopped) std::raise(SIGINT);
      return 1.0;
    });
    EXPECT_EQ(judged, stopped + 1);
    EXPECT_FALSE(dressing.reference);
    EXPECT_EQ(dressing.worn, -1);
  }
}

}  // namespace
}  // namespace invsim
