// SPDX-License-Identifier: Apache-2.0
// Garments worn by a person who sits down: with self-contact no face crosses
// another at any frame of dressing and motion, where without it they do.
#include <gtest/gtest.h>

#include "geometry/triangle_crossing.h"
#include "invsim/body/mannequin.h"
#include "invsim/body/motion.h"
#include "invsim/cloth/authored_garment.h"
#include "invsim/cloth/named_materials.h"
#include "invsim/sim/relaxation.h"
#include "invsim/sim/scene.h"

namespace invsim {
namespace {

struct Worn {
  int frames = 0;
  int worst = 0;  // pairs of faces that cross, at any frame
  int most = 0;   // contacts of cloth with cloth in a step
  int missed = 0;
  bool complete = false;
};

// The T-pose, in which the garment is made, changes to legs pressed together
// and drawn up to the chest.
Motion Sit() {
  Motion motion;
  PoseVector pose = PoseVector::Zero();
  for (const int side : {0, 1}) {
    pose[3 * (kLeftHip + side)] = -1.9;
    pose[3 * (kLeftHip + side) + 2] = side == 0 ? -0.12 : 0.12;
    pose[3 * (kLeftKnee + side)] = 1.2;
  }
  for (const int joint : {kSpine1, kSpine2, kSpine3}) pose[3 * joint] = 0.25;
  motion.poses = {pose, pose, pose};
  motion.translations.assign(3, Vector3d::Zero());
  return motion;
}

Worn Wear(const Garment& garment, bool self_contact) {
  const BodyModel& body = Mannequin();
  const Motion motion = Sit();
  const std::vector<BodyParameters> frames = motion.Frames();
  SceneOptions scene;
  scene.effects = {"inertia", "gravity", "membrane", "bending"};
  if (self_contact) scene.effects.push_back("self_contact");
  Simulator simulator(MakeSetup(scene, body, garment, FindMaterial("silk")));
  RelaxationOptions relaxation;
  relaxation.settle_seconds = 0.05;
  relaxation.move_seconds = 0.4;
  relaxation.hold_seconds = 0;
  Worn worn;
  const auto look = [&](const ClothState& cloth, const FrameStats& stats) {
    ++worn.frames;
    worn.worst = std::max(worn.worst, CountCrossings(cloth.x, garment.faces));
    worn.most = std::max(worn.most, stats.step.most_cloth_contacts);
    worn.missed += stats.step.missed;
  };
  const RelaxationResult dressed =
      Relax({body, garment, frames, motion.frame_rate},
            relaxation,
            &simulator,
            [&](const RelaxationFrame& f) { look(f.cloth, f.stats); });
  ClothState cloth = dressed.cloth;
  const RolloutResult result = SimulateSequence(
      &simulator,
      [&](int t) { return body.Vertices(frames[t]); },
      motion.num_frames(),
      motion.frame_rate,
      &cloth,
      [&](const SimulatedFrame& f) { look(f.cloth, f.stats); });
  worn.complete = dressed.status == RunStatus::kComplete &&
                  result.status == RunStatus::kComplete;
  return worn;
}

class DressedLayersTest : public testing::TestWithParam<const char*> {};

TEST_P(DressedLayersTest, DoNotCross) {
  const BodyModel& body = Mannequin();
  const Garment garment = AuthoredGarment(
      GetParam(),
      {body.Vertices({}), body.faces(), body.Joints({}), body.data().weights},
      {.edge_length = 0.06});
  const Worn with = Wear(garment, true);
  EXPECT_TRUE(with.complete);
  EXPECT_EQ(with.worst, 0);
  EXPECT_GT(with.most, 0);
  EXPECT_EQ(with.missed, 0);
  EXPECT_GT(with.frames, 12);
  EXPECT_GT(Wear(garment, false).worst, 0);
}

INSTANTIATE_TEST_SUITE_P(Garments,
                         DressedLayersTest,
                         testing::Values("dress", "trousers"),
                         [](const auto& garment) {
                           return std::string(garment.param);
                         });

}  // namespace
}  // namespace invsim
