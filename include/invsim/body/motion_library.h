// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_BODY_MOTION_LIBRARY_H_
#define INVSIM_BODY_MOTION_LIBRARY_H_

// Motions that need no file, drawn by us: smooth (accelerations are
// continuous), starting from rest, any length at any frame rate. They are made
// for the mannequin, whose feet stay on the floor (the lowest point of the
// feet keeps its height to within a centimetre); other bodies of about its
// proportions can use them.

#include <string>
#include <vector>

#include "invsim/body/motion.h"

namespace invsim {

// arms_down_and_swing, walk_in_place, turn, squat.
std::vector<std::string> MotionNames();

// What a motion is, in a line. Throws UsageError naming the motions there are.
std::string MotionDescription(const std::string& name);

// `frames` frames at `frame_rate` per second. Throws UsageError naming the
// motions there are, or if frames < 1 or the rate is not positive.
Motion MakeMotion(const std::string& name,
                  int frames,
                  double frame_rate = 30.0);

}  // namespace invsim

#endif  // INVSIM_BODY_MOTION_LIBRARY_H_
