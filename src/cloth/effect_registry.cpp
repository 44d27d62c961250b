// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/effect_registry.h"

#include "invsim/cloth/effects/bending.h"
#include "invsim/cloth/effects/gravity.h"
#include "invsim/cloth/effects/inertia.h"
#include "invsim/cloth/effects/membrane.h"
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

EffectRegistry MakeRegistry() {
  EffectRegistry r("effect");
  r.Add<NoOptions>(
      "inertia", "mass of the cloth; without it quasi-static", MakeInertia);
  r.Add<GravityOptions>("gravity", "uniform gravity", MakeGravity);
  r.Add<NoOptions>("membrane",
                   "in-plane elasticity, finite elements, law by material",
                   MakeMembrane);
  r.Add<NoOptions>("bending", "hinge bending, law by material", MakeBending);
  return r;
}

}  // namespace

const EffectRegistry& Effects() {
  static const EffectRegistry registry = MakeRegistry();
  return registry;
}

}  // namespace invsim
