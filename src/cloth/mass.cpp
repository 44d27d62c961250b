// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/mass.h"

#include "invsim/cloth/rest_shape.h"

namespace invsim {

VectorXd VertexMasses(const Garment& garment, const Material& material) {
  VectorXd masses = VectorXd::Zero(garment.num_vertices());
  for (int f = 0; f < garment.num_faces(); ++f)
    for (int a = 0; a < 3; ++a)
      masses[garment.faces(a, f)] +=
          material.density * RestArea(garment, f) / 3.0;
  return masses;
}

}  // namespace invsim
