// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CONTACT_CONTACT_H_
#define INVSIM_CONTACT_CONTACT_H_

// One contact as the frictional solve sees it: a weighted point of the cloth
// against a moving plane.
//
// The relative velocity, gap included, is u = sum_k weight_k v_{vertex_k} - w.
// A contact with the body has one vertex of weight 1. A contact of the cloth
// with itself has up to four vertices, those of the other side with negative
// weights, and w holds only the gap.

#include <array>
#include <vector>

#include "invsim/base/types.h"

namespace invsim {

enum class ContactKind {
  kUnilateral,  // Signorini-Coulomb
  kPin,         // u = 0 whatever the force
};

struct Contact {
  ContactKind kind = ContactKind::kUnilateral;
  int num_vertices = 1;
  std::array<int, 4> vertex = {-1, -1, -1, -1};
  std::array<double, 4> weight = {1, 0, 0, 0};
  Vector3d normal = Vector3d::UnitY();   // from the obstacle to the cloth
  Vector3d velocity = Vector3d::Zero();  // w, m/s
  double friction = 0;                   // mu
  // u is replaced by u + compliance r. Zero is the exact law, possible for one
  // contact on a vertex; where several meet, a small compliance tells their
  // forces apart and keeps contradictory ones (a vertex squeezed between two
  // overlapping body parts) solvable.
  double compliance = 0;  // (m/s)/N

  bool exact() const { return compliance == 0; }

  // sum_k weight_k v_{vertex_k} of stacked velocities.
  Vector3d Gather(const VectorXd& v) const {
    Vector3d sum = Vector3d::Zero();
    for (int k = 0; k < num_vertices; ++k)
      sum += weight[k] * v.segment<3>(3 * vertex[k]);
    return sum;
  }
  // f += G^T r.
  void Scatter(const Vector3d& r, VectorXd* f) const {
    for (int k = 0; k < num_vertices; ++k)
      f->segment<3>(3 * vertex[k]) += weight[k] * r;
  }
};

}  // namespace invsim

#endif  // INVSIM_CONTACT_CONTACT_H_
