// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_BODY_MANNEQUIN_H_
#define INVSIM_BODY_MANNEQUIN_H_

// A body that needs no file: a mannequin of 1.70 m, drawn by us in code, with
// the joints, order and use of SMPL (whose numbers mean other bodies: shape and
// pose are not interchangeable). T-pose, facing +z, its left on +x, soles at
// y = -1.1; one closed surface of about 3,500 vertices, symmetric to the last
// bit, its smallest angle above 18 degrees. There are no pose blend shapes.

#include <array>

#include "invsim/body/body_model.h"

namespace invsim {

// What the ten shape coefficients do. One unit is about one standard deviation
// among adults; joints follow. They are meant for use within -2 to 2 each.
enum class MannequinShape {
  kHeight,     // all of the body 4 % larger
  kWeight,     // all girths, the belly most
  kShoulders,  // each shoulder 1.2 cm further out
  kHips,       // each hip 1.1 cm further out, fuller buttocks
  kLimbs,      // arms 2.2 cm, legs 3 cm longer
  kChest,      // a wider, deeper chest
  kBelly,      // a rounder belly and waist
  kArms,       // arms 10 % thicker
  kLegs,       // legs 8 % thicker
  kHeadSize,   // a head 3 % larger on a neck 6 % thicker
};

struct MannequinShapeInfo {
  const char* name;     // "height"
  const char* meaning;  // of one unit
};
extern const std::array<MannequinShapeInfo, kNumShape> kMannequinShapes;

// Computed when first asked for (in less than a second), the same on every run
// of one build. Compiled for another processor, rounding may lead the remesher
// to another mesh of the same surface: a body that is to be shared is written
// with WriteBodyModel.
const BodyModel& Mannequin();

}  // namespace invsim

#endif  // INVSIM_BODY_MANNEQUIN_H_
