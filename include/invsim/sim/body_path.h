// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SIM_BODY_PATH_H_
#define INVSIM_SIM_BODY_PATH_H_

// The way of the body before a sequence begins: from the T-pose, in which the
// garment was made, to the first pose.
//
// Physics does not care where on the floor a person stands or which way they
// face, so the T-posed body (and the garment with it) is put there first: its
// pelvis where that of the first pose is, its heading that of the first pose.
// What is left to simulate is what does matter, the limbs and the shape, not a
// dash across the room or a spin that would wrap the cloth round the body.

#include <span>

#include "invsim/body/body_model.h"

namespace invsim {

// The part about +y of a rotation (its twist; 0 if it stands on its head),
// as an axis-angle vector.
Vector3d Heading(const Vector3d& rotation);

struct StartingPlace {
  BodyParameters body;   // in the T-pose
  Matrix3d rotation;     // x = rotation x_made + translation takes the garment
  Vector3d translation;  // from where it was made to that body
};

// `shape`: the body's shape for which the garment was made.
StartingPlace PlaceAtStart(const BodyModel& model,
                           const BodyParameters& first,
                           const ShapeVector& shape);

// Where the body is `seconds` (at most 0) before the first frame, if it gets
// from a standstill at -lead_in to the velocity between the first two frames,
// 1/dt apart, at constant acceleration:
//
//   p(t) = p_0 + v (t + t^2 / (2 T)),  v = (p_1 - p_0) / dt,  -T <= t <= 0 .
//
// With fewer than two frames, or no lead-in, it stands at the first.
BodyParameters BeforeFirst(std::span<const BodyParameters> motion,
                           double frames_per_second,
                           double lead_in,
                           double seconds);

}  // namespace invsim

#endif  // INVSIM_SIM_BODY_PATH_H_
