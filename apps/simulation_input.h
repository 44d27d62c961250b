// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_APPS_SIMULATION_INPUT_H_
#define INVSIM_APPS_SIMULATION_INPUT_H_

// What the commands that simulate forwards take: section `input`.

#include <string>
#include <vector>

#include "inputs.h"
#include "invsim/cloth/material.h"

namespace invsim {

struct SimulationInput {
  std::string body = "mannequin";
  std::string garment = "tshirt";
  AuthoredGarmentOptions authored;
  MotionInput motion;
};
void Describe(OptionTable* table, SimulationInput* input);

// The same, loaded.
struct SimulationScene {
  BodyModel body;
  Garment garment;
  Motion motion;
  Material material;
  std::vector<BodyParameters> frames;
};

// Throws UsageError or InputError, as for a garment that does not lie around
// the T-posed body.
SimulationScene LoadSimulation(const SimulationInput& input,
                               const std::string& material);

}  // namespace invsim

#endif  // INVSIM_APPS_SIMULATION_INPUT_H_
