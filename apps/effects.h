// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_APPS_EFFECTS_H_
#define INVSIM_APPS_EFFECTS_H_

// Fills SceneOptions::decisions from what a command has read, and says in the
// log (-v) why each effect is on or off.

#include "fit_inputs.h"
#include "invsim/sim/relaxation.h"
#include "invsim/sim/scene.h"

namespace invsim {

void DecideSceneEffects(const RelaxationScene& scene,
                        const Material& material,
                        const RelaxationOptions& relaxation,
                        SceneOptions* options);

// From the motion to start from, if there is one, else from the points.
void DecideFitEffects(const FitData& data,
                      double frames_per_second,
                      const RelaxationOptions& relaxation,
                      SceneOptions* options);

}  // namespace invsim

#endif  // INVSIM_APPS_EFFECTS_H_
