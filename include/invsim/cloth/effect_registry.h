// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CLOTH_EFFECT_REGISTRY_H_
#define INVSIM_CLOTH_EFFECT_REGISTRY_H_

// All effects by name. An effect registered here can be listed in a scene,
// shows in `invsim list effects`, and is taken up by the test that checks
// force, stiffness and derivatives of every registered effect.

#include "invsim/base/registry.h"
#include "invsim/cloth/effect.h"
#include "invsim/cloth/garment.h"
#include "invsim/cloth/material.h"

namespace invsim {

using EffectRegistry = Registry<Effect, const Garment&, const Material&>;

const EffectRegistry& Effects();

}  // namespace invsim

#endif  // INVSIM_CLOTH_EFFECT_REGISTRY_H_
