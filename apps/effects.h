// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_APPS_EFFECTS_H_
#define INVSIM_APPS_EFFECTS_H_

// Fills SceneOptions::decisions from what a command has read or found, and says
// in the log (-v) why each effect is on or off.

#include <memory>

#include "fit_inputs.h"
#include "invsim/sim/relaxation.h"
#include "invsim/sim/scene.h"

namespace invsim {

void DecideSceneEffects(const RelaxationScene& scene,
                        const Material& material,
                        const RelaxationOptions& relaxation,
                        SceneOptions* options);

// Decides for the motion a fit starts from, and makes its simulator.
std::unique_ptr<Simulator> MakeFitSimulator(const FitData& data,
                                            const BodySequence& start,
                                            double frames_per_second,
                                            const RelaxationOptions& relaxation,
                                            SceneOptions* options);

}  // namespace invsim

#endif  // INVSIM_APPS_EFFECTS_H_
