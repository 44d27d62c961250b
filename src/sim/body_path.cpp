// SPDX-License-Identifier: Apache-2.0
#include "invsim/sim/body_path.h"

#include <algorithm>
#include <cmath>

#include "invsim/body/motion.h"
#include "invsim/body/rotation.h"

namespace invsim {
namespace {

// A rotation whose quaternion has less than this of (w, y) has no heading.
constexpr double kNoHeading = 1e-6;

}  // namespace

Vector3d Heading(const Vector3d& rotation) {
  // Of the quaternion (cos x/2, sin x/2 axis) the part (w, y) is the twist.
  const double angle = rotation.norm();
  const double w = std::cos(0.5 * angle);
  const double y = 0.5 * SinOverX(0.25 * angle * angle) * rotation.y();
  if (std::hypot(w, y) < kNoHeading) return Vector3d::Zero();
  double heading = 2 * std::atan2(y, w);
  if (heading > M_PI) heading -= 2 * M_PI;
  if (heading < -M_PI) heading += 2 * M_PI;
  return heading * Vector3d::UnitY();
}

StartingPlace PlaceAtStart(const BodyModel& model,
                           const BodyParameters& first,
                           const ShapeVector& shape) {
  BodyParameters made;
  made.shape = shape;
  const Vector3d made_pelvis = model.Joints(made).col(0);
  const Vector3d first_pelvis = model.Joints(first).col(0);

  StartingPlace start;
  start.body.shape = shape;
  start.body.pose.head<3>() = Heading(first.pose.head<3>());
  start.body.translation = first_pelvis - made_pelvis;
  start.rotation = Exp(start.body.pose.head<3>());
  start.translation = first_pelvis - start.rotation * made_pelvis;
  return start;
}

BodyParameters BeforeFirst(std::span<const BodyParameters> motion,
                           double frames_per_second,
                           double lead_in,
                           double seconds) {
  if (motion.size() < 2 || lead_in <= 0 || seconds >= 0) return motion[0];
  const double t = std::max(seconds, -lead_in);
  const double s = frames_per_second * (t + t * t / (2 * lead_in));
  return Interpolate(motion[0], motion[1], s);
}

}  // namespace invsim
