// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SIM_FIELDS_H_
#define INVSIM_SIM_FIELDS_H_

// What cloth and body feel, per vertex, as it is written to files.

#include "invsim/cloth/garment.h"
#include "invsim/cloth/material.h"

namespace invsim {

struct ClothFields {
  // Largest stretch in any direction less one: sqrt(1 + 2 E_max) - 1 with
  // E_max the larger eigenvalue of Green's strain. 0.02 is 2 % longer; below
  // zero the cloth is compressed in every direction.
  VectorXd strain;
  VectorXd stress;  // von Mises, of the membrane's Cauchy stress, N/m
};

// Of the faces round each vertex at positions x, weighted by rest area.
ClothFields MeasureCloth(const Garment& garment,
                         const StretchModel& model,
                         const Points& x);

// Pressure on a surface from the forces on its vertices (3 x V, N): the inward
// part of the force over a third of the area of the faces round the vertex,
// Pa. Negative would be a pull.
VectorXd Pressure(const Points& vertices,
                  const Faces& faces,
                  const Points& force);

}  // namespace invsim

#endif  // INVSIM_SIM_FIELDS_H_
