// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_BODY_MOTION_H_
#define INVSIM_BODY_MOTION_H_

// A moving body: one shape, and pose and translation frame by frame, as AMASS
// keeps them (Mahmood et al., AMASS, 2019) and as invsim writes its results.

#include <string>
#include <vector>

#include "invsim/body/body_model.h"
#include "invsim/io/input_frame.h"
#include "invsim/io/npz.h"

namespace invsim {

struct Motion {
  double frame_rate = 30.0;  // frames per second
  ShapeVector shape = ShapeVector::Zero();
  std::vector<PoseVector> poses;       // radians
  std::vector<Vector3d> translations;  // metres, as many as poses
  std::string gender = "neutral";

  int num_frames() const { return static_cast<int>(poses.size()); }
  BodyParameters Frame(int t) const {
    return {shape, poses[t], translations[t]};
  }
  std::vector<BodyParameters> Frames() const {
    std::vector<BodyParameters> frames;
    for (int t = 0; t < num_frames(); ++t) frames.push_back(Frame(t));
    return frames;
  }
};

// Reads an AMASS npz:
//
//   poses (T,72), trans (T,3), betas (10 or more; the first ten are used; a
//   missing one is zeros), gender (a missing one is "neutral"),
//   mocap_framerate or mocap_frame_rate (the name changed once; if there are
//   both they must agree).
//
// Of poses (T,156) (SMPL-H) and (T,165) (SMPL-X) the first 66 numbers are the
// 22 joints of the body; the two hand joints of SMPL stay straight. Nothing is
// turned: see TurnWorld for files with z up. Throws InputError, also of numbers
// beyond a million rad or m.
Motion ReadMotion(const std::string& path);
// The same of a file's bytes; `path` opens messages.
Motion ParseMotion(std::string npz, const std::string& path);

// Writes the same in 64 bits, with both names of the frame rate.
void WriteMotion(const std::string& path, const Motion& motion);
// What it writes, for files that hold more beside it.
NpzArrays MotionArrays(const Motion& motion);

// Turns the world about its origin: every vertex x of every frame becomes R x.
// A root that turns about the pelvis J_0(beta) makes both of its parameters
// change, and needs the body:
//
//   x = Exp(theta_0) (y - J_0) + J_0 + t
//   R x:  Exp(theta_0') = R Exp(theta_0),  t' = R (J_0 + t) - J_0 .
void TurnWorld(const Matrix3d& rotation, const BodyModel& body, Motion* motion);

// The rotation that brings an input with this axis up to y up (input_frame.h).
// AMASS itself has z up.
Matrix3d YUpFrom(UpAxis up);

// Parameters on the way from a (s = 0) to b (s = 1), or beyond: shape and
// translation on straight lines, each joint's rotation at constant angular
// velocity the shortest way, as the vector nearest to a's.
BodyParameters Interpolate(const BodyParameters& a,
                           const BodyParameters& b,
                           double s);

// The same motion, same beginning, at another frame rate: rotations run on the
// sphere between the frames there are. The last frame is the last that is not
// after the old one's. Throws UsageError unless the rate is positive.
Motion Resample(const Motion& motion, double frame_rate);

// Replaces each joint's vector by that of the same rotation nearest to the
// frame before. Recordings keep vectors within half a turn, where a smooth
// rotation that goes further wraps to the other side, and differences of
// vectors, as in L_t, see a jump. What remains is a turn that passes near a
// whole one about a tilting axis (a dancer's root): differences of rotations
// (GeodesicDistance) are safe always.
void UnwrapPoses(Motion* motion);

}  // namespace invsim

#endif  // INVSIM_BODY_MOTION_H_
