// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_STUDY_CLOSED_FACES_H_
#define INVSIM_SRC_STUDY_CLOSED_FACES_H_

// Where bending has no angle to resist: a face that has closed to a line turns
// freely about it, and an angle that goes past pi, as neighbours go through
// each other, comes out on the other side. Either way cloth has energy of
// bending (cloth/effects/hinge.h) from nowhere a moment later.

#include <vector>

#include "invsim/cloth/garment.h"
#include "invsim/geometry/mesh.h"

namespace invsim {

class ClosedFaces {
 public:
  explicit ClosedFaces(const Garment& garment);

  // Takes the cloth's vertices after a further step, the first time where it
  // starts, and counts.
  void Add(const Points& vertices);

  // Faces of less than kCollapse of their area at rest, and angles that differ
  // by more than pi from the step before; over all steps.
  int count() const { return count_; }

 private:
  VectorXd Angles(const Points& vertices) const;

  Faces faces_;
  VectorXd smallest_;  // m^2, of each face: below it is closed
  std::vector<Edge> hinges_;
  VectorXd last_;  // angles; empty: no step yet
  int count_ = 0;
};

}  // namespace invsim

#endif  // INVSIM_SRC_STUDY_CLOSED_FACES_H_
