// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_FIT_BODY_SEQUENCE_H_
#define INVSIM_FIT_BODY_SEQUENCE_H_

// The unknowns of a fit: one shape, and pose and translation of every frame.

#include <vector>

#include "invsim/body/body_model.h"

namespace invsim {

struct BodySequence {
  ShapeVector shape = ShapeVector::Zero();
  std::vector<PoseVector> poses;       // axis-angle, radians
  std::vector<Vector3d> translations;  // metres

  int num_frames() const { return static_cast<int>(poses.size()); }
  BodyParameters Frame(int t) const {
    return {shape, poses[t], translations[t]};
  }
  void Append(const BodyParameters& p) {
    poses.push_back(p.pose);
    translations.push_back(p.translation);
  }
};

// A Gaussian filter in time of standard deviation `sigma` frames (0: as it
// is), on rotations and not on their vectors: each joint turns by the weighted
// mean of the rotations that lead to its neighbours in time,
//
//   R_t <- R_t Exp(sum_k g_k Log(R_t^T R_{t+k})),  |k| <= 3 sigma.
//
// At the ends the window is cut on both sides alike and renormalised, so that
// a steady motion is left as it is. Vectors come out no longer than pi.
BodySequence GaussianFilter(const BodySequence& sequence, double sigma);

// Each joint's vector replaced by that of the same rotation no longer than pi,
// far from 2 pi, where a vector loses two of its directions.
void Canonicalize(PoseVector* pose);

}  // namespace invsim

#endif  // INVSIM_FIT_BODY_SEQUENCE_H_
