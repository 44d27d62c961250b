// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_SIM_ENERGY_BALANCE_H_
#define INVSIM_SRC_SIM_ENERGY_BALANCE_H_

// Whether a step made energy from nowhere.

#include <memory>
#include <vector>

#include "invsim/cloth/effect.h"
#include "invsim/sim/frame_record.h"

namespace invsim {

using EffectList = std::vector<std::unique_ptr<Effect>>;

double KineticEnergy(const VectorXd& mass, const ClothState& state);  // J
double PotentialEnergy(const EffectList& effects,
                       const ClothState& state);  // J

// What a step to `end` has gained beyond the work of its contacts and of the
// effects that are not conservative (what those take away is not counted), as a
// share of all energy that went about in it: a linearisation does not see the
// strain that the step's own turning makes.
double EnergyGain(const VectorXd& mass,
                  const EffectList& effects,
                  const SubstepRecord& sub,
                  const ClothState& end);

}  // namespace invsim

#endif  // INVSIM_SRC_SIM_ENERGY_BALANCE_H_
