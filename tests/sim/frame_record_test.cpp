// SPDX-License-Identifier: Apache-2.0
#include "invsim/sim/frame_record.h"

#include <gtest/gtest.h>

#include "invsim/sim/scene.h"
#include "sim/test_scene.h"

namespace invsim {
namespace {

class FrameRecordTest : public testing::Test {
 protected:
  FrameRecordTest() : body_(BallBody()), sheet_(SheetAboveBall(4, 0.2, 0.001)) {
    options_.step.substeps = 2;
  }
  FrameRecord Fall(double friction, double drift = 0) {
    options_.contact.friction = friction;
    Simulator simulator(MakeSetup(options_, body_, sheet_, PlainCloth()));
    ClothState state{sheet_.placed, Points::Zero(3, sheet_.num_vertices())};
    const Points rest = body_.Vertices({});
    const Points moved = rest.colwise() + Vector3d(drift, 0, 0);
    StepStats stats;
    FrameRecord record;
    EXPECT_TRUE(
        simulator.Advance(rest, moved, 1 / 30.0, &state, &stats, &record));
    EXPECT_GT(stats.stick + stats.slide, 0);
    return record;
  }
  BodyModel body_;
  Garment sheet_;
  SceneOptions options_;
};

TEST_F(FrameRecordTest, TheSameFrameHasTheSameContacts) {
  EXPECT_TRUE(SameContacts(Fall(0.3), Fall(0.3)));
}

TEST_F(FrameRecordTest, AnotherFaceVertexOrNumberOfContactsIsAnotherPiece) {
  const FrameRecord record = Fall(0.3);
  FrameRecord other = Fall(0.3);
  other.substeps[1].sources[0].face += 1;
  EXPECT_FALSE(SameContacts(record, other));
  other = Fall(0.3);
  other.substeps[0].sources[0].vertex += 1;
  EXPECT_FALSE(SameContacts(record, other));
  other = Fall(0.3);
  other.substeps[1].sources.pop_back();
  EXPECT_FALSE(SameContacts(record, other));
  other = Fall(0.3);
  other.substeps.pop_back();
  EXPECT_FALSE(SameContacts(record, other));
}

TEST_F(FrameRecordTest, SlidingIsNotSticking) {
  // The ball slips away under the cloth, or takes it along.
  EXPECT_FALSE(SameContacts(Fall(0.0, 1e-4), Fall(5.0, 1e-4)));
}

}  // namespace
}  // namespace invsim
