// SPDX-License-Identifier: Apache-2.0
#include "limb_starts.h"

#include <utility>

#include "invsim/base/joints.h"

namespace invsim {
namespace {

constexpr int kLeft = 0, kRight = 1;  // sides
// Among the starts of a leg.
constexpr int kForward = 2, kBackward = 3;

// A rotation of the left side as its mirror image.
Vector3d Mirrored(int side, double x, double y, double z) {
  return side == kLeft ? Vector3d(x, y, z) : Vector3d(x, -y, -z);
}

// In the T-pose the left arm points along +x, the face along +z: about -y it
// comes forward, about -z down.
Limb Arm(int side) {
  const int collar = kLeftCollar + side, shoulder = kLeftShoulder + side,
            elbow = kLeftElbow + side, wrist = kLeftWrist + side;
  Limb limb{{collar, shoulder, elbow, wrist}, {}};
  const Vector3d shoulders[] = {Mirrored(side, 0, 0, 0),
                                Mirrored(side, 0, 0, -1.25),
                                Mirrored(side, 0, -1.3, 0),
                                Mirrored(side, 0, 0, 1.2),
                                Mirrored(side, 0.3, -0.8, -1.25)};
  const Vector3d elbows[] = {Vector3d::Zero(),
                             Mirrored(side, 0, -1.6, 0),
                             Mirrored(side, 0, -1.6, 0.8)};
  for (const Vector3d& s : shoulders)
    for (const Vector3d& e : elbows)
      limb.starts.push_back({{{collar, Vector3d::Zero()},
                              {shoulder, s},
                              {elbow, e},
                              {wrist, Vector3d::Zero()}}});
  return limb;
}

// Two limbs moved at once, each start of one with its like of the other.
Limb Both(const Limb& a, const Limb& b) {
  Limb both = a;
  both.joints.insert(both.joints.end(), b.joints.begin(), b.joints.end());
  for (size_t k = 0; k < both.starts.size(); ++k) {
    std::vector<LimbStart::Turn>& turns = both.starts[k].turns;
    const auto& more = b.starts[k].turns;
    turns.insert(turns.end(), more.begin(), more.end());
  }
  return both;
}

// About -x the thigh comes forward, about +x the shank goes back.
Limb Leg(int side) {
  const int hip = kLeftHip + side, knee = kLeftKnee + side,
            ankle = kLeftAnkle + side;
  Limb limb{{hip, knee, ankle}, {}};
  const auto add = [&](const Vector3d& h, double bend) {
    limb.starts.push_back(
        {{{hip, h}, {knee, Vector3d(bend, 0, 0)}, {ankle, Vector3d::Zero()}}});
  };
  add(Vector3d::Zero(), 0);
  add(Mirrored(side, 0, 0, 0.4), 0);
  add(Vector3d(-0.5, 0, 0), 0.3);
  add(Vector3d(0.4, 0, 0), 0.5);
  add(Vector3d(-1.2, 0, 0), 1.3);
  return limb;
}

// Legs that took each other's place have turned pelvis and spine as well. In a
// stride one leg starts as the other does in its own.
Limb BothLegs() {
  Limb right = Leg(kRight);
  std::swap(right.starts[kForward], right.starts[kBackward]);
  Limb legs = Both(Leg(kLeft), right);
  legs.joints.insert(legs.joints.end(), {kPelvis, kSpine1});
  return legs;
}

}  // namespace

BodyParameters LimbStart::From(const BodyParameters& body) const {
  BodyParameters start = body;
  for (const Turn& turn : turns)
    start.pose.segment<3>(3 * turn.joint) = turn.rotation;
  return start;
}

std::vector<Limb> Limbs() {
  const Limb left = Arm(kLeft), right = Arm(kRight);
  return {Both(left, right), left, right, BothLegs(), Leg(kLeft), Leg(kRight)};
}

}  // namespace invsim
