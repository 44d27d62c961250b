// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SIM_EFFECT_CHOICE_H_
#define INVSIM_SIM_EFFECT_CHOICE_H_

// Which effects a scene calls for: `scene.effects = "auto"`.
//
// Each effect is measured by the largest force it can have in the scene, as a
// share of the cloth's weight; it is left out if that share is below
// kNegligible. With rho the mass per area (kg/m^2), g gravity, u and a the
// largest speed and acceleration of the sequence (sim/scene_motion.h):
//
//   gravity            on unless its acceleration is zero
//   membrane           on: without it the cloth has no size
//   bending            B / (rho g l^3), the cube of bending length over mean
//                      edge l: the force of a hinge bent by a radian
//   inertia            a / g, the dressing's acceleration included. It is left
//                      out only if mass damping holds loose cloth instead:
//                      falling at its terminal speed g / alpha it must not
//                      cross the margin of the contact search in one step
//   mass damping       alpha u / g; on where inertia is left out
//   air drag           (rho_air c_n u^2 / 2 + l_n u) / (rho g), u with the wind
//   stiffness damping  its time constant over the length of a step, which
//                      itself damps as that time constant would (implicit
//                      Euler): left out below kLostInStep
//   self contact       on if distant parts of the garment can come within its
//                      thickness of each other
//
// Without gravity there is no weight to compare with, and what the motion
// decides is on. Without friction the skin does not carry the cloth, which may
// slide off as fast as it likes: u is not known. What is not known of the
// motion counts as large; an effect with no rule here is on; one whose
// constants are zero is off.
//
// Friction and the direction- and strain-dependence of measured fabrics are
// not effects of the registry but belong to contact and material. They are
// decided by them (mu > 0; the kind of material) and are reported beside the
// effects.

#include <string>
#include <vector>

#include "invsim/cloth/garment.h"
#include "invsim/cloth/material.h"
#include "invsim/sim/scene_motion.h"

namespace invsim {

struct SceneOptions;

inline constexpr char kAutoEffects[] = "auto";
inline constexpr double kNegligible = 0.01;  // share of the cloth's weight
inline constexpr double kLostInStep = 0.2;   // share of the step's own damping

struct EffectDecision {
  std::string name;
  bool on = false;
  std::string reason;  // a few words, with the figure that decided
  // A property of contact or material instead of an effect of the registry.
  bool built_in = false;
};

// One decision per effect of the registry, in its order, then "friction" and
// "measured_fabric". If the scene lists its effects, the list decides.
std::vector<EffectDecision> DecideEffects(const SceneOptions& options,
                                          const Garment& garment,
                                          const Material& material,
                                          const SceneMotion& motion);

// How near layers of the garment may come before contact, of the cloth with
// itself or of both with a body between them, keeps them apart, m.
double LayerThickness(const SceneOptions& options);

// The registry's effects that are on, in order.
std::vector<std::string> EffectsOn(const std::vector<EffectDecision>& all);

// A line per decision: "air_drag  off  (0.2 % of the cloth's weight ...)".
std::string DecisionsText(const std::vector<EffectDecision>& all);

}  // namespace invsim

#endif  // INVSIM_SIM_EFFECT_CHOICE_H_
