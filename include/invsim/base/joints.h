// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_BASE_JOINTS_H_
#define INVSIM_BASE_JOINTS_H_

// SMPL's 24 joints by their numbers, in which bodies, motions and garments
// agree. Of a pair the right one follows the left.

namespace invsim {

enum SmplJoint {
  kPelvis,
  kLeftHip,
  kRightHip,
  kSpine1,
  kLeftKnee,
  kRightKnee,
  kSpine2,
  kLeftAnkle,
  kRightAnkle,
  kSpine3,
  kLeftFoot,
  kRightFoot,
  kNeck,
  kLeftCollar,
  kRightCollar,
  kHead,
  kLeftShoulder,
  kRightShoulder,
  kLeftElbow,
  kRightElbow,
  kLeftWrist,
  kRightWrist,
  kLeftHand,
  kRightHand
};

}  // namespace invsim

#endif  // INVSIM_BASE_JOINTS_H_
