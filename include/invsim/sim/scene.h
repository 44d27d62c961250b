// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SIM_SCENE_H_
#define INVSIM_SIM_SCENE_H_

// From what a user chooses (effects, material, contact, step) and a body and a
// garment to a simulator:
//
//   SceneOptions scene;
//   OptionTable table;
//   Describe(&table, &scene);   // scene.*, effects.*, contact.*, step.*
//   table.Read(config);
//   Material material = ...;
//   UseMaterialFriction(table, material, &scene);
//   scene.decisions = DecideEffects(scene, garment, material, motion);
//   Simulator simulator(MakeSetup(scene, body, garment, material));

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "invsim/base/options.h"
#include "invsim/body/body_model.h"
#include "invsim/cloth/effect_registry.h"
#include "invsim/cloth/garment.h"
#include "invsim/cloth/material.h"
#include "invsim/geometry/mesh.h"
#include "invsim/sim/effect_choice.h"
#include "invsim/sim/simulator.h"

namespace invsim {

struct SceneOptions {
  SceneOptions();

  // Names from the registry of effects, or "auto" alone. Only these are built.
  std::vector<std::string> effects = {
      "inertia", "gravity", "membrane", "bending"};
  // What DecideEffects made of that. As long as it is empty, "auto" is decided
  // for a motion of which nothing is known.
  std::vector<EffectDecision> decisions;
  // A named material or the path of an ARCSim material (.json).
  std::string material = "jersey";
  BodyContactOptions contact;
  StepOptions step;
  // The options of every registered effect by name, listed or not, so that a
  // configuration may hold them while the effect is switched on and off.
  std::map<std::string,
           std::unique_ptr<Choice<Effect, const Garment&, const Material&>>>
      effect_options;
};

// Keys scene.effects, scene.material, effects.NAME.*, contact.*, step.*.
void Describe(OptionTable* table, SceneOptions* options);

// The material's own friction, unless `table` (read by now) was told one.
void UseMaterialFriction(const OptionTable& table,
                         const Material& material,
                         SceneOptions* options);

// The names of the effects that are built. Throws UsageError for one that is
// unknown or listed twice, or for "auto" with others beside it.
std::vector<std::string> ChosenEffects(const SceneOptions& options,
                                       const Garment& garment,
                                       const Material& material);

// Throws as ChosenEffects does. A body without faces is none: there is nothing
// to collide with.
SimulatorSetup MakeSetup(const SceneOptions& options,
                         const TriangleMesh& body,
                         const Garment& garment,
                         const Material& material);
SimulatorSetup MakeSetup(const SceneOptions& options,
                         const BodyModel& body,
                         const Garment& garment,
                         const Material& material);

// Throws InputError, opened by `name`, if the garment does not lie around the
// T-posed body of the given shape, as a garment made for another body or in
// another unit: more than a quarter of its vertices inside the body, or no
// vertex within 10 cm of it.
void CheckGarmentFits(const Garment& garment,
                      const BodyModel& body,
                      const ShapeVector& shape,
                      const std::string& name);

}  // namespace invsim

#endif  // INVSIM_SIM_SCENE_H_
