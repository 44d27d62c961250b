// SPDX-License-Identifier: Apache-2.0
#include "closed_faces.h"

#include <numbers>
#include <utility>

#include "invsim/cloth/effects/hinge.h"
#include "invsim/cloth/rest_shape.h"

namespace invsim {

ClosedFaces::ClosedFaces(const Garment& garment)
    : faces_(garment.faces), smallest_(garment.faces.cols()) {
  for (Eigen::Index f = 0; f < faces_.cols(); ++f)
    smallest_[f] = kCollapse * RestArea(garment, static_cast<int>(f));
  for (const Edge& edge : Edges(faces_))
    if (edge.faces[1] >= 0) hinges_.push_back(edge);
}

void ClosedFaces::Add(const Points& vertices) {
  VectorXd angles = Angles(vertices);
  count_ += static_cast<int>(
      (FaceAreas(vertices, faces_).array() < smallest_.array()).count());
  if (last_.size() > 0)
    count_ += static_cast<int>(
        ((angles - last_).array().abs() > std::numbers::pi).count());
  last_ = std::move(angles);
}

VectorXd ClosedFaces::Angles(const Points& vertices) const {
  VectorXd angles(hinges_.size());
  for (size_t i = 0; i < hinges_.size(); ++i) {
    const Edge& e = hinges_[i];
    Hinge::Vertices x;
    x << vertices.col(e.a), vertices.col(e.b), vertices.col(e.opposite[0]),
        vertices.col(e.opposite[1]);
    // Lengths and areas at rest bound its gradient only.
    angles[i] = Hinge::At(x, 1, 1, 1).angle;
  }
  return angles;
}

}  // namespace invsim
