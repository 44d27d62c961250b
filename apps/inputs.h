// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_APPS_INPUTS_H_
#define INVSIM_APPS_INPUTS_H_

// Body, motion and garment by the name of something embedded or by path.

#include <string>
#include <vector>

#include "invsim/base/options.h"
#include "invsim/body/body_model.h"
#include "invsim/body/motion.h"
#include "invsim/cloth/authored_garment.h"
#include "invsim/cloth/garment.h"

namespace invsim {

// Whether `name` is meant as a path: it has a slash or a dot.
bool IsPath(const std::string& name);

// "mannequin", "cube" or an SMPL-layout npz, in metres, head up along y.
// Throws UsageError or InputError.
BodyModel LoadBody(const std::string& name);

// What an authored garment is made round.
TPoseBody TPoseOf(const BodyModel& body);

// An authored garment's name, made round `body`; "sheet", lying on it; or an
// OBJ.
Garment LoadGarment(const std::string& name,
                    const BodyModel& body,
                    const AuthoredGarmentOptions& options);
void Describe(OptionTable* table, AuthoredGarmentOptions* options);

struct MotionInput {
  std::string name = "walk_in_place";  // embedded, or an AMASS npz
  UpAxis up = UpAxis::kY;              // of the file
  bool up_is_said = false;             // by the user: not to be doubted
  int first = 0;                       // frame, at the rate asked for
  int frames = 0;                      // 0: all there are
  double frames_per_second = 0;        // 0: as the file has it, or 30
  std::vector<double> shape;           // empty: the motion's own
};
// Keys motion, motion_up, first_frame, frames, frames_per_second, shape.
void Describe(OptionTable* table, MotionInput* options);

// At least one frame. Throws UsageError or InputError, the latter also of a
// file that clearly has z up, unless the user said which axis is up.
Motion LoadMotion(const MotionInput& input, const BodyModel& body);

}  // namespace invsim

#endif  // INVSIM_APPS_INPUTS_H_
