// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CLOTH_CARRY_H_
#define INVSIM_CLOTH_CARRY_H_

// Dressing a body of another shape: a garment placed round the T-posed body of
// one shape (beta = 0) is moved so that it lies round the T-posed body of
// another. Only the placement changes. The rest shape is the garment's size,
// which a bigger wearer does not alter: cloth carried to a bigger body starts
// stretched, to a smaller one slack, and the simulation settles it.
//
// A cloth vertex x moves by a weighted mean of the body's displacements d_j
// (Shepard's interpolation, A two-dimensional interpolation function for
// irregularly-spaced data, 1968),
//
//   u(x) = sum_j w_j d_j / sum_j w_j,   w_j = A_j / (|x - y_j|^2 + s^2)^2,
//
// y_j the body's vertices, A_j their areas, s = 2 cm: smooth everywhere, like
// the skin's own displacement close to it, an average of both sides between
// arm and trunk. The body changes in several stages, and after each the cloth
// is pushed clear of the skin.

#include <string>

#include "invsim/base/types.h"
#include "invsim/cloth/garment.h"

namespace invsim {

struct CarryOptions {
  int stages = 4;
  // Least distances from the skin aimed at, metres.
  double vertex_clearance = 0.003;
  double face_clearance = 0.002;
};

// `from` and `to` are the two T-posed bodies (3 x V each) with the same closed
// `faces`. Throws InputError, `name` first, if the bodies do not match, or if
// the carried garment would lie less than two thirds of a wanted clearance off
// the skin or cross itself where it did not before.
Garment CarryGarment(const Garment& garment,
                     const Points& from,
                     const Points& to,
                     const Faces& faces,
                     const std::string& name,
                     const CarryOptions& options = {});

// The displacement u at each point of `cloth` (3 x N).
Points CarryDisplacement(const Points& cloth,
                         const Points& from,
                         const Points& to,
                         const Faces& faces);

}  // namespace invsim

#endif  // INVSIM_CLOTH_CARRY_H_
