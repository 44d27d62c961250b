// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/effect_registry.h"

#include <utility>
#include <vector>

#include "invsim/cloth/effects/air_drag.h"
#include "invsim/cloth/effects/bending.h"
#include "invsim/cloth/effects/gravity.h"
#include "invsim/cloth/effects/inertia.h"
#include "invsim/cloth/effects/mass_damping.h"
#include "invsim/cloth/effects/membrane.h"
#include "invsim/cloth/effects/self_contact.h"
#include "invsim/cloth/effects/stiffness_damping.h"
#include "invsim/cloth/mass.h"

namespace invsim {
namespace {

std::unique_ptr<Effect> MakeInertia(const NoOptions&,
                                    const Garment&,
                                    const Material&) {
  return std::make_unique<Inertia>();
}

std::unique_ptr<Effect> MakeGravity(const GravityOptions& options,
                                    const Garment& garment,
                                    const Material& material) {
  return std::make_unique<Gravity>(VertexMasses(garment, material), options);
}

std::unique_ptr<Effect> MakeMembrane(const NoOptions&,
                                     const Garment& garment,
                                     const Material& material) {
  return std::make_unique<Membrane>(garment, material.stretch);
}

std::unique_ptr<Effect> MakeBending(const NoOptions&,
                                    const Garment& garment,
                                    const Material& material) {
  return std::make_unique<Bending>(garment, material.bending);
}

// Damps the K of membrane and bending made from the same material, whether or
// not the scene lists those effects.
std::unique_ptr<Effect> MakeStiffnessDamping(
    const StiffnessDampingOptions& options,
    const Garment& garment,
    const Material& material) {
  std::vector<StiffnessDamping::Term> terms;
  if (options.membrane > 0.0)
    terms.push_back({std::make_unique<Membrane>(garment, material.stretch),
                     options.membrane});
  if (options.bending > 0.0)
    terms.push_back({std::make_unique<Bending>(garment, material.bending),
                     options.bending});
  return std::make_unique<StiffnessDamping>(std::move(terms));
}

std::unique_ptr<Effect> MakeMassDamping(const MassDampingOptions& options,
                                        const Garment& garment,
                                        const Material& material) {
  return std::make_unique<MassDamping>(VertexMasses(garment, material),
                                       options);
}

std::unique_ptr<Effect> MakeAirDrag(const AirDragOptions& options,
                                    const Garment& garment,
                                    const Material&) {
  return std::make_unique<AirDrag>(garment.faces, options);
}

std::unique_ptr<Effect> MakeSelfContact(const SelfContactOptions& options,
                                        const Garment& garment,
                                        const Material&) {
  return std::make_unique<SelfContact>(garment, options);
}

EffectRegistry MakeRegistry() {
  EffectRegistry r("effect");
  r.Add<NoOptions>(
      "inertia", "mass of the cloth; without it quasi-static", MakeInertia);
  r.Add<GravityOptions>("gravity", "uniform gravity", MakeGravity);
  r.Add<NoOptions>("membrane",
                   "in-plane elasticity, finite elements, law by material",
                   MakeMembrane);
  r.Add<NoOptions>("bending", "hinge bending, law by material", MakeBending);
  r.Add<StiffnessDampingOptions>(
      "stiffness_damping",
      "damping of stretching and bending, in proportion to their stiffness",
      MakeStiffnessDamping);
  r.Add<MassDampingOptions>("mass_damping",
                            "damping of all motion, in proportion to mass",
                            MakeMassDamping);
  r.Add<AirDragOptions>("air_drag", "drag of the air, and wind", MakeAirDrag);
  r.Add<SelfContactOptions>("self_contact",
                            "contact of the cloth with itself, with friction",
                            MakeSelfContact);
  return r;
}

}  // namespace

const EffectRegistry& Effects() {
  static const EffectRegistry registry = MakeRegistry();
  return registry;
}

}  // namespace invsim
