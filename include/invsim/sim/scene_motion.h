// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SIM_SCENE_MOTION_H_
#define INVSIM_SIM_SCENE_MOTION_H_

// How fast a scene moves, as far as that can be known before it is simulated:
// what decides which effects matter in it (sim/effect_choice.h).
//
// Cloth is taken along by the skin nearest to it. Every vertex of the garment
// is tied to the point of the T-posed body's surface closest to it, and those
// points are followed along the way from the T-pose to the first pose and
// through the sequence:
//
//   speed         largest |p_t - p_{t-1}| f
//   acceleration  largest |p_{t+1} - 2 p_t + p_{t-1}| f^2, with p_{-1} = p_0
//                 unless there is a lead-in: the body sets out from rest
//
// f: frames per second. What is not known is infinite.

#include <limits>
#include <vector>

#include "invsim/base/types.h"
#include "invsim/sim/relaxation.h"

namespace invsim {

struct SceneMotion {
  static constexpr double kUnknown = std::numeric_limits<double>::infinity();

  double frames_per_second = 0;             // 0: not known
  double speed = kUnknown;                  // of the sequence, m/s
  double acceleration = kUnknown;           // of the sequence, m/s^2
  double dressing_acceleration = kUnknown;  // from T-pose to first pose, m/s^2
  double steps_per_second = 0;              // of the dressing; 0: not known
  // Whether distant parts of the garment may come within its thickness.
  bool layers_can_meet = true;
};

// From a known motion. `thickness` of the cloth, m.
SceneMotion MeasureMotion(const RelaxationScene& scene,
                          const RelaxationOptions& options,
                          double thickness);

// Whether two vertices of the garment more than `kFarEdges` mean edges apart
// where it was made can come within `thickness` of each other: each stays
// within its distance from the skin, `slack`, of the point it is tied to.
// `anchors`: those points, a column per vertex, per frame.
inline constexpr double kFarEdges = 4;
bool LayersCanMeet(const Garment& garment,
                   const std::vector<Points>& anchors,
                   const VectorXd& slack,
                   double thickness);

}  // namespace invsim

#endif  // INVSIM_SIM_SCENE_MOTION_H_
