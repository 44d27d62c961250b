// SPDX-License-Identifier: Apache-2.0
#include "mannequin_shape.h"

#include <cmath>

#include "mannequin_skin.h"
#include "smooth_step.h"

namespace invsim {
namespace {

// Each direction is drawn on the left half (x >= 0) and mirrored; where it
// meets the middle it must have no x component there.

// How much a place belongs to the trunk: not to arms, legs, neck or head.
double Trunk(const Vector3d& x) {
  return (1.0 - ArmShare(x)) * (1.0 - SmoothStep(.24, .34, x.y()));
}

Vector3d Height(const Vector3d& x) { return 0.04 * x; }

// Away from the axis of the arm by a share of the distance.
Vector3d ArmGirth(const Vector3d& x) {
  const double taper = 1.0 - 0.65 * SmoothStep(.45, .72, x.x());
  return ArmShare(x) * taper * Vector3d(0.0, x.y() - .250, x.z() + .010);
}

// Away from the axis of the leg; near the crotch away from its inner side, so
// that the thighs do not grow into each other.
Vector3d LegGirth(const Vector3d& x) {
  const double leg = SmoothStep(-.14, -.34, x.y());
  const double taper = 1.0 - 0.75 * SmoothStep(-.75, -1.02, x.y());
  const double knee_x = .100 + .025 * SmoothStep(-.55, -1.05, x.y());
  const double inner = SmoothStep(-.62, -.38, x.y());
  const double axis_x = knee_x + inner * (.012 - knee_x);
  const double across = x.x() - axis_x;
  // Not inward of the middle between the legs.
  const double side = SmoothStep(0.0, .03, x.x());
  return leg * taper *
         Vector3d(side * (1.0 - .45 * inner) * across, 0.0, x.z());
}

Vector3d TrunkGirth(const Vector3d& x) {
  const double share = Trunk(x) * (1.0 - 0.8 * SmoothStep(-.24, -.40, x.y()));
  return share * Vector3d(x.x(), 0.0, x.z());
}

// The front of the belly and the sides of the waist.
Vector3d Belly(const Vector3d& x) {
  const double share = Trunk(x) * Bump(-.30, -.06, -.06, .16, x.y());
  const double front = SmoothStep(-.03, .10, x.z());
  return share * Vector3d(.085 * x.x(), 0.0, .021 * front + .03 * x.z());
}

Vector3d Weight(const Vector3d& x) {
  const double neck = Bump(.25, .33, .38, .43, x.y()) * (1.0 - ArmShare(x));
  return 0.055 * TrunkGirth(x) + 0.6 * Belly(x) + 0.08 * ArmGirth(x) +
         0.06 * LegGirth(x) + 0.05 * neck * Vector3d(x.x(), 0.0, x.z() + .005);
}

Vector3d Shoulders(const Vector3d& x) {
  const double height =
      SmoothStep(.0, .19, x.y()) * (1.0 - SmoothStep(.29, .37, x.y()));
  return {.012 * height * EvenStep(.025, .150, .025, x.x()), 0.0, 0.0};
}

Vector3d Hips(const Vector3d& x) {
  const double height = Bump(-.03, -.20, -.26, -.56, x.y());
  const double back = SmoothStep(.02, -.08, x.z());
  return height * Vector3d(.011 * EvenStep(.02, .130, .02, x.x()),
                           0.0,
                           -.006 * back * Bump(-.05, -.25, -.27, -.42, x.y()));
}

Vector3d Limbs(const Vector3d& x) {
  const double arm = EvenStep(.185, .690, .02, x.x());
  const double leg = EvenStep(.300, 1.00, .05, -x.y());
  return {.022 * arm, -.030 * leg, 0.0};
}

Vector3d Chest(const Vector3d& x) {
  const double share = Trunk(x) * Bump(-.03, .13, .17, .29, x.y());
  const double front = SmoothStep(-.02, .09, x.z());
  return share * Vector3d(.060 * x.x(), 0.0, .010 * front + .05 * x.z());
}

Vector3d Head(const Vector3d& x) {
  const double middle = 1.0 - ArmShare(x);
  const double head = SmoothStep(.33, .42, x.y()) * middle;
  const double neck = Bump(.25, .31, .36, .42, x.y()) * middle;
  return 0.03 * head * (x - Vector3d(0.0, .35, 0.0)) +
         0.06 * neck * Vector3d(x.x(), 0.0, x.z() + .008);
}

Vector3d OnTheLeft(MannequinShape shape, const Vector3d& x) {
  switch (shape) {
    case MannequinShape::kHeight:
      return Height(x);
    case MannequinShape::kWeight:
      return Weight(x);
    case MannequinShape::kShoulders:
      return Shoulders(x);
    case MannequinShape::kHips:
      return Hips(x);
    case MannequinShape::kLimbs:
      return Limbs(x);
    case MannequinShape::kChest:
      return Chest(x);
    case MannequinShape::kBelly:
      return Belly(x);
    case MannequinShape::kArms:
      return 0.10 * ArmGirth(x);
    case MannequinShape::kLegs:
      return 0.08 * LegGirth(x);
    case MannequinShape::kHeadSize:
      return Head(x);
  }
  return Vector3d::Zero();
}

}  // namespace

Vector3d MannequinShapeDisplacement(MannequinShape shape, const Vector3d& x) {
  Vector3d d = OnTheLeft(shape, Vector3d(std::abs(x.x()), x.y(), x.z()));
  if (x.x() < 0.0) d.x() = -d.x();
  if (x.x() == 0.0) d.x() = 0.0;
  return d;
}

}  // namespace invsim
