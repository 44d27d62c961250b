// SPDX-License-Identifier: Apache-2.0
#include "invsim/body/motion.h"

#include <algorithm>
#include <cmath>

#include "invsim/base/error.h"
#include "invsim/body/rotation.h"

namespace invsim {
namespace {

// A frame this close after the end, in frames, is the end.
constexpr double kSameFrame = 1e-6;

}  // namespace

void TurnWorld(const Matrix3d& rotation,
               const BodyModel& body,
               Motion* motion) {
  BodyParameters rest;
  rest.shape = motion->shape;
  const Vector3d pelvis = body.Joints(rest).col(0);
  for (int t = 0; t < motion->num_frames(); ++t) {
    auto root = motion->poses[t].head<3>();
    root = Log(rotation * Exp(root));
    Vector3d& translation = motion->translations[t];
    translation = rotation * (pelvis + translation) - pelvis;
  }
}

Matrix3d YUpFrom(UpAxis up) {
  InputFrame frame;
  frame.up = up;
  return InsideFromInput(frame, Matrix3d::Identity());
}

BodyParameters Interpolate(const BodyParameters& a,
                           const BodyParameters& b,
                           double s) {
  BodyParameters p;
  p.shape = a.shape + s * (b.shape - a.shape);
  p.translation = a.translation + s * (b.translation - a.translation);
  for (int j = 0; j < kNumJoints; ++j) {
    const Vector3d from = a.pose.segment<3>(3 * j);
    const Vector3d to = b.pose.segment<3>(3 * j);
    p.pose.segment<3>(3 * j) =
        NearestEquivalent(Log(Slerp(Exp(from), Exp(to), s)), from);
  }
  return p;
}

Motion Resample(const Motion& motion, double frame_rate) {
  if (!(frame_rate > 0.0) || !std::isfinite(frame_rate)) {
    throw UsageError("frame rate " + std::to_string(frame_rate) +
                     ": expected a positive number of frames per second");
  }
  Motion out = motion;
  out.frame_rate = frame_rate;
  out.poses.clear();
  out.translations.clear();
  const int last = motion.num_frames() - 1;
  const double step = motion.frame_rate / frame_rate;
  for (int k = 0; k * step <= last + kSameFrame; ++k) {
    const int t = std::clamp(static_cast<int>(k * step), 0, last);
    const double s = std::min(k * step - t, 1.0);
    const BodyParameters p =
        s == 0.0 ? motion.Frame(t)
                 : Interpolate(
                       motion.Frame(t), motion.Frame(std::min(t + 1, last)), s);
    out.poses.push_back(p.pose);
    out.translations.push_back(p.translation);
  }
  return out;
}

void UnwrapPoses(Motion* motion) {
  for (int t = 1; t < motion->num_frames(); ++t) {
    for (int j = 0; j < kNumJoints; ++j) {
      auto pose = motion->poses[t].segment<3>(3 * j);
      pose = NearestEquivalent(pose, motion->poses[t - 1].segment<3>(3 * j));
    }
  }
}

}  // namespace invsim
