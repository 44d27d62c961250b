// SPDX-License-Identifier: Apache-2.0
#include "simulation_input.h"

#include <utility>

#include "invsim/cloth/named_materials.h"
#include "invsim/sim/scene.h"

namespace invsim {

void Describe(OptionTable* table, SimulationInput* input) {
  table->Add("body",
             &input->body,
             {.doc = "mannequin, cube, or the path of an SMPL-layout npz"});
  table->Add("garment",
             &input->garment,
             {.doc = "an authored garment, sheet, or the path of an OBJ placed "
                     "around the T-posed body"});
  Describe(table, &input->authored);
  Describe(table, &input->motion);
}

SimulationScene LoadSimulation(const SimulationInput& input,
                               const std::string& material) {
  // The quickest first, the making of a garment last.
  Material cloth = FindMaterial(material);
  BodyModel body = LoadBody(input.body);
  Motion motion = LoadMotion(input.motion, body);
  Garment garment = LoadGarment(input.garment, body, input.authored);
  CheckGarmentFits(garment, body, ShapeVector::Zero(), input.garment);
  std::vector<BodyParameters> frames = motion.Frames();
  return {std::move(body),
          std::move(garment),
          std::move(motion),
          std::move(cloth),
          std::move(frames)};
}

}  // namespace invsim
