// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CONTACT_CLOTH_CONTACT_H_
#define INVSIM_CONTACT_CLOTH_CONTACT_H_

// Contacts of the cloth with itself (effect "self_contact").
//
// Proximity. In a sub-step of length dt that starts at x0, a pair of a vertex
// and a face, or of two edges, is a contact if its distance d is within the
// thickness h, a margin and the way of its relative motion. Its nearest points
// are weighted sums of the vertices of the feature they lie on; sum_k w_k x0_k
// leads from one to the other, along the normal n. The pair may not come nearer
// than h:
//
//   u = sum_k w_k v_k - w,   w = n min((h - d)/dt, recovery speed),   u . n >=
//   0
//
// with Coulomb friction in u, in the same problem as the contacts with the
// body. A vertex makes contacts with faces that it is nearest to within, two
// edges if they are nearest within both; a vertex with an edge or a vertex
// where the distance has a local minimum and is less than h. h is less for
// parts of the cloth that are next to each other, as in a mesh finer than h:
// half the distance in which they were made, at most. Forces act on all
// vertices of the pair by their weights, so that they sum to zero, with no
// moment but that of the friction over d.
//
// Sweep. After the solve every pair is followed over the way it moves
// (FirstTimeWithin). One that would come within a tenth of h gets a plane
// through its nearest points at that time, and the step is solved again. What
// still touches after some rounds is stopped: the vertices of such pairs go
// only a part of their way. So layers that start apart end apart, always.
//
// Pairs are left out where the cloth crosses itself at the start already (as a
// garment may be made so): the faces that cross and those round them do not
// keep each other from parting.

#include <array>
#include <memory>
#include <vector>

#include "invsim/base/types.h"
#include "invsim/cloth/effects/self_contact.h"
#include "invsim/contact/contact.h"
#include "invsim/geometry/element_pair.h"

namespace invsim {

// On what the nearest points lie, in the order of their vertices.
enum class PairFeature { kVertexVertex, kVertexEdge, kVertexFace, kEdgeEdge };

// Where a contact of the list came from.
struct ClothContact {
  int contact;  // index in the list of contacts
  PairFeature feature;
  std::array<int, 4> vertex;  // as many as the feature has, then -1
  double side;                // of faces and edge pairs: +1 or -1
  double thickness;           // h of this pair, m
  // Found by the sweep: normal and weights are those at the time of touching,
  // and the derivative takes them as fixed.
  bool swept = false;
};

// Normal, velocity and weights of one contact.
struct ClothPlane {
  Vector3d normal;
  Vector3d velocity;  // w
  Eigen::Vector4d weights;
  double distance;  // d
};
// Rows: dn (3), dw (3), the weights (4); columns: four vertices at the start.
using ClothPlaneJacobian = Eigen::Matrix<double, 10, 12>;

// Columns of `x` beyond those of the feature are not read.
ClothPlane EvaluateClothPlane(const SelfContactOptions& options,
                              double dt,
                              const ClothContact& contact,
                              const PairPoints& x);
// Of a contact that was not swept.
ClothPlaneJacobian DifferentiateClothPlane(const SelfContactOptions& options,
                                           double dt,
                                           const ClothContact& contact,
                                           const PairPoints& x);

class ClothContactDetector {
 public:
  // `mass` in kg per vertex.
  ClothContactDetector(const SelfContact& effect,
                       const Faces& faces,
                       const VectorXd& mass);
  ~ClothContactDetector();

  const SelfContactOptions& options() const;

  // Adds the contacts of a sub-step that starts at x0 with velocity v0.
  void Detect(double dt,
              const Points& x0,
              const Points& v0,
              std::vector<Contact>* contacts,
              std::vector<ClothContact>* sources);
  // How many pairs of faces crossed each other at x0 of the last Detect.
  int crossings() const;

  // Follows every pair from x0 of the last Detect to x1 and adds, or renews,
  // contacts for those that touch. Returns how many do.
  int Sweep(const Points& x1,
            std::vector<Contact>* contacts,
            std::vector<ClothContact>* sources);

  // The share of its way to x1 that each vertex may go so that no pair
  // touches; 1 where nothing is in the way.
  VectorXd Stop(const Points& x1);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace invsim

#endif  // INVSIM_CONTACT_CLOTH_CONTACT_H_
