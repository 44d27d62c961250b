// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CLOTH_MASS_H_
#define INVSIM_CLOTH_MASS_H_

#include "invsim/cloth/garment.h"
#include "invsim/cloth/material.h"

namespace invsim {

// Lumped mass of each vertex, kg: areal density times a third of the rest area
// of the faces round it.
VectorXd VertexMasses(const Garment& garment, const Material& material);

}  // namespace invsim

#endif  // INVSIM_CLOTH_MASS_H_
