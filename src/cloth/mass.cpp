// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/mass.h"

namespace invsim {

VectorXd VertexMasses(const Garment& garment, const Material& material) {
  return material.density * VertexAreas(garment);
}

}  // namespace invsim
