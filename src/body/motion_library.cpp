// SPDX-License-Identifier: Apache-2.0
#include "invsim/body/motion_library.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "invsim/base/error.h"
#include "invsim/base/joints.h"
#include "invsim/base/names.h"
#include "invsim/body/rotation.h"
#include "mannequin_skin.h"
#include "smooth_step.h"

namespace invsim {
namespace {

constexpr double kPi = std::numbers::pi;

auto Joint(int j, PoseVector* pose) { return pose->segment<3>(3 * j); }

// From the T-pose: x turns a limb back (positive: down from forward), y turns
// the left arm back, z lifts it; the right arm mirrors y and z.
void SetPair(int left, const Vector3d& v, PoseVector* pose) {
  Joint(left, pose) = v;
  Joint(left + 1, pose) = Vector3d(v.x(), -v.y(), -v.z());
}

// Arms lowered by a share of the way from the T-pose to the sides, elbows a
// little bent.
void LowerArms(double share, PoseVector* pose) {
  SetPair(kLeftShoulder, share * Vector3d(0.0, -0.15, -1.17), pose);
  SetPair(kLeftElbow, share * Vector3d(0.0, -0.25, 0.0), pose);
}

// A swing that starts from rest: its amplitude grows over the first 1.2 s.
double Swing(double seconds, double period) {
  return SmoothStep(0.0, 1.2, seconds) * std::sin(2 * kPi * seconds / period);
}

PoseVector ArmsDownAndSwing(double seconds) {
  PoseVector pose = PoseVector::Zero();
  LowerArms(SmoothStep(0.0, 1.5, seconds), &pose);
  const double swing = seconds > 1.5 ? Swing(seconds - 1.5, 1.4) : 0.0;
  // Before the arm is lowered: a swing about the body's x axis.
  for (int side = 0; side < 2; ++side) {
    auto shoulder = Joint(kLeftShoulder + side, &pose);
    const double sign = side == 0 ? 1.0 : -1.0;
    shoulder = Log(Exp(Vector3d(-0.55 * sign * swing, 0, 0)) * Exp(shoulder));
    Joint(kLeftElbow + side, &pose).y() -= sign * 0.15 * swing * swing;
  }
  Joint(kSpine2, &pose).y() = -0.08 * swing;
  return pose;
}

PoseVector WalkInPlace(double seconds) {
  PoseVector pose = PoseVector::Zero();
  LowerArms(1.0, &pose);
  const double swing = Swing(seconds, 1.2);
  for (int side = 0; side < 2; ++side) {
    const double sign = side == 0 ? 1.0 : -1.0;
    // A leg is lifted in its half of the period, and stands in the other.
    const double lift = std::pow(std::max(0.0, sign * swing), 2.0);
    Joint(kLeftHip + side, &pose).x() = -0.75 * lift;
    Joint(kLeftKnee + side, &pose).x() = 1.15 * lift;
    Joint(kLeftAnkle + side, &pose).x() = -0.20 * lift;
    auto shoulder = Joint(kLeftShoulder + side, &pose);
    shoulder = Log(Exp(Vector3d(0.40 * sign * swing, 0, 0)) * Exp(shoulder));
  }
  Joint(kSpine1, &pose).y() = 0.06 * swing;
  Joint(kSpine3, &pose).y() = 0.06 * swing;
  return pose;
}

PoseVector Turn(double seconds) {
  PoseVector pose = PoseVector::Zero();
  SetPair(kLeftShoulder, Vector3d(0.0, -0.10, -0.90), &pose);
  SetPair(kLeftElbow, Vector3d(0.0, -0.20, 0.0), &pose);
  // A quarter turn a second, reached smoothly within one; the head leads.
  const double speed = 0.5 * kPi;
  const double ramp = std::min(seconds, 1.0);
  // The integral of SmoothStep(0, 1, .) up to ramp.
  const double eased = std::pow(ramp, 4) * (2.5 + ramp * (ramp - 3.0));
  Joint(kPelvis, &pose).y() = speed * (eased + std::max(0.0, seconds - 1.0));
  Joint(kHead, &pose).y() = 0.25 * SmoothStep(0.0, 1.0, seconds);
  return pose;
}

PoseVector Squat(double seconds) {
  PoseVector pose = PoseVector::Zero();
  // Down and up within three seconds, from rest to rest.
  const double phase = std::fmod(seconds, 3.0);
  const double down = Bump(0.0, 1.3, 1.5, 2.8, phase);
  LowerArms(1.0, &pose);
  for (int side = 0; side < 2; ++side) {
    auto shoulder = Joint(kLeftShoulder + side, &pose);
    shoulder = Log(Exp(Vector3d(-1.15 * down, 0, 0)) * Exp(shoulder));
  }
  SetPair(kLeftHip, Vector3d(-1.35 * down, 0.0, 0.12 * down), &pose);
  SetPair(kLeftKnee, Vector3d(1.65 * down, 0.0, 0.0), &pose);
  SetPair(kLeftAnkle, Vector3d(-0.62 * down, 0.0, 0.0), &pose);
  Joint(kPelvis, &pose).x() = 0.32 * down;
  Joint(kSpine1, &pose).x() = 0.10 * down;
  Joint(kSpine3, &pose).x() = 0.10 * down;
  Joint(kHead, &pose).x() = -0.30 * down;
  return pose;
}

struct NamedMotion {
  const char* name;
  const char* description;
  PoseVector (*pose)(double seconds);
};

const std::array<NamedMotion, 4> kMotions = {{
    {"arms_down_and_swing",
     "from the T-pose the arms go down, then swing",
     ArmsDownAndSwing},
    {"walk_in_place", "steps on the spot with swinging arms", WalkInPlace},
    {"turn", "a turn to the left on the spot, a quarter a second", Turn},
    {"squat", "a deep squat with arms raised forward, every 3 s", Squat},
}};

const NamedMotion& Find(const std::string& name) {
  for (const NamedMotion& motion : kMotions) {
    if (motion.name == name) return motion;
  }
  throw UsageError(UnknownName("motion", name, MotionNames()));
}

// Where heel and ball of both feet are, by the mannequin's joints, with the
// root turned only as far as it leans.
std::array<Vector3d, 4> Soles(const PoseVector& pose) {
  const Points& rest = MannequinJoints();
  // The heading does not move the feet away from under the body.
  const Vector3d root(pose[0], 0.0, 0.0);
  std::array<Vector3d, 4> soles;
  for (int side = 0; side < 2; ++side) {
    Matrix3d rotation = Exp(root);
    Vector3d place = rest.col(kPelvis);
    int parent = kPelvis;
    for (const int joint :
         {kLeftHip + side, kLeftKnee + side, kLeftAnkle + side}) {
      place += rotation * (rest.col(joint) - rest.col(parent));
      rotation = rotation * Exp(pose.segment<3>(3 * joint));
      parent = joint;
    }
    const Vector3d ankle = rest.col(kLeftAnkle + side);
    const Vector3d ball = rest.col(kLeftFoot + side);
    const Vector3d heel_sole(ankle.x(), -1.1, -0.07);
    const Vector3d ball_sole(ball.x(), -1.1, ball.z());
    soles[2 * side] = place + rotation * (heel_sole - ankle);
    soles[2 * side + 1] = place + rotation * (ball_sole - ankle);
  }
  return soles;
}

// Keeps the soles that are lowest where they are at rest: their mean, with
// weights that fall off within centimetres above the lowest.
Vector3d GroundingTranslation(const PoseVector& pose) {
  constexpr double kSharpness = 200.0;  // 1 / m
  const std::array<Vector3d, 4> soles = Soles(pose);
  const std::array<Vector3d, 4> rest = Soles(PoseVector::Zero());
  double lowest = soles[0].y();
  for (const Vector3d& sole : soles) lowest = std::min(lowest, sole.y());
  double sum = 0.0;
  Vector3d shift = Vector3d::Zero();
  for (std::size_t k = 0; k < soles.size(); ++k) {
    const double weight = std::exp(-kSharpness * (soles[k].y() - lowest));
    sum += weight;
    shift += weight * (rest[k] - soles[k]);
  }
  return shift / sum;
}

}  // namespace

std::vector<std::string> MotionNames() {
  std::vector<std::string> names;
  for (const NamedMotion& motion : kMotions) names.emplace_back(motion.name);
  return names;
}

std::string MotionDescription(const std::string& name) {
  return Find(name).description;
}

Motion MakeMotion(const std::string& name, int frames, double frame_rate) {
  const NamedMotion& named = Find(name);
  if (frames < 1 || !(frame_rate > 0.0) || !std::isfinite(frame_rate)) {
    throw UsageError("motion of " + std::to_string(frames) + " frames at " +
                     std::to_string(frame_rate) +
                     " per second: expected at least one frame and a positive "
                     "rate");
  }
  Motion motion;
  motion.frame_rate = frame_rate;
  for (int t = 0; t < frames; ++t) {
    motion.poses.push_back(named.pose(t / frame_rate));
    motion.translations.push_back(GroundingTranslation(motion.poses.back()));
  }
  return motion;
}

}  // namespace invsim
