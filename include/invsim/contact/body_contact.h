// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CONTACT_BODY_CONTACT_H_
#define INVSIM_CONTACT_BODY_CONTACT_H_

// Contacts of cloth vertices with a moving closed surface (the body).
//
// In one sub-step of length dt the surface goes from p0 to p1 and a cloth
// vertex starts at x0. The closest point of the surface at the start has the
// barycentric weights b on some feature (face, edge or vertex) of a face. The
// surface's velocity there is V = sum_k b_k (p1_k - p0_k)/dt. Carried along
// with it, x0 arrives at x_c = x0 + dt V; the closest point of x_c on the same
// feature at p1 is y, at signed distance d, in the direction n (the face's
// normal, or from y to x_c on an edge or a vertex, turned outwards). The vertex
// may not pass the plane at distance h, the thickness, above y:
//
//   u = v - w,   w = V + n min((h - d)/dt, recovery speed),   u . n >= 0 .
//
// u is the paper's v^, gap included. Stick, u = 0, moves the vertex exactly
// with its point of the surface.
//
// Several contacts on one vertex (armpit, between the thighs) are the local
// minima of the distance over the surface that are within reach. A vertex
// inside the body is led out through the nearest point.
//
// A face that is no such minimum at the start of the step may still be run into
// before its end: the next one, where the surface is hollow. That shows in the
// solution, and the step is solved again with that face's plane, which is a
// contact like the others (FindSlipped).

#include <memory>
#include <vector>

#include "invsim/base/types.h"
#include "invsim/contact/contact.h"
#include "invsim/geometry/closest_point.h"

namespace invsim {

class OptionTable;
class SurfaceIndex;

struct BodyContactOptions {
  double thickness = 0.002;     // h, m
  double friction = 0.3;        // mu
  double margin = 0.003;        // how far beyond h contacts are sought, m
  double recovery_speed = 1.0;  // at most, out of the body, m/s
  // Compliance of contacts that share a vertex, as a share of the vertex's own:
  // they yield by this much of the way on which their force would take the
  // vertex if its neighbours held still. Between parts of the body that press
  // with 1,000 weights and more that is millimetres; the simulator solves a
  // step again in which one yields by more than 1 mm while the others on its
  // vertex, all of them outside the body, are open: with that one exact.
  double shared_compliance = 1e-2;
};
void Describe(OptionTable* table, BodyContactOptions* options);

// Where a contact of the list came from.
struct BodyContact {
  int contact;  // index in the list of contacts
  int vertex;   // of the cloth
  int face;     // of the body
  TriangleFeature feature;
  double side;  // +1: the vertex is outside, -1: inside
  // Barycentric, at the start of the sub-step; of one that FindSlipped found,
  // at its end.
  Vector3d weights;
};

// n and w of one contact and their derivatives.
struct ContactPlane {
  Vector3d normal;
  Vector3d velocity;
  double distance;  // d
};
// Columns: x0 (3), the face's corners at the start (9) and at the end (9).
using ContactPlaneJacobian = Eigen::Matrix<double, 6, 21>;

ContactPlane EvaluateContactPlane(const BodyContactOptions& options,
                                  double dt,
                                  TriangleFeature feature,
                                  double side,
                                  const Vector3d& x0,
                                  const Matrix3d& corners0,
                                  const Matrix3d& corners1);
// Rows: dn (3), dw (3).
ContactPlaneJacobian DifferentiateContactPlane(
    const BodyContactOptions& options,
    double dt,
    TriangleFeature feature,
    double side,
    const Vector3d& x0,
    const Matrix3d& corners0,
    const Matrix3d& corners1);

class BodyContactDetector {
 public:
  BodyContactDetector(const Points& body, const Faces& faces);
  ~BodyContactDetector();

  const Faces& faces() const;

  // Finds which cloth vertices are inside the body and how deep: to be called
  // whenever positions were not reached by steps of this detector, and once in
  // a while to be sure. Returns how many are inside.
  int FindInside(const Points& body, const Points& x);

  // The contacts of a sub-step in which the body moves from body0 to body1 and
  // the cloth starts at x0 with velocity v0. `resistance`, per vertex: the
  // force that gives it 1 m/s while its neighbours hold still, N s/m. Contacts
  // are sought as far as v0 takes a vertex and, if `v1` is given, a guess at
  // the velocity at the end, as far as that does.
  void Detect(const BodyContactOptions& options,
              double dt,
              const Points& body0,
              const Points& body1,
              const Points& x0,
              const Points& v0,
              const VectorXd& resistance,
              std::vector<Contact>* contacts,
              std::vector<BodyContact>* sources,
              const Points* v1 = nullptr);

  // Adds contacts for vertices that keep clear of every plane they were given
  // and yet end inside the body, moving with `v1` (the solution): in a step
  // that takes a vertex beyond the face it slides on, it meets the next one
  // where the surface is hollow. How many. What else is on such a vertex
  // becomes compliant.
  int FindSlipped(const BodyContactOptions& options,
                  double dt,
                  const Points& body0,
                  const Points& body1,
                  const Points& x0,
                  const Points& v1,
                  const VectorXd& resistance,
                  std::vector<Contact>* contacts,
                  std::vector<BodyContact>* sources);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace invsim

#endif  // INVSIM_CONTACT_BODY_CONTACT_H_
