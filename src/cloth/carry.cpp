// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/carry.h"

#include <cstdio>

#include "invsim/base/error.h"
#include "invsim/base/threads.h"
#include "invsim/cloth/clearance.h"
#include "invsim/geometry/mesh.h"
#include "invsim/geometry/self_intersection.h"
#include "invsim/geometry/surface_index.h"

namespace invsim {
namespace {

// Within this distance all vertices count about the same, metres: more than
// the spacing of a body's vertices, so that none stands out.
constexpr double kSpread = 0.02;
// What is left of a wanted clearance when a garment counts as failed.
constexpr double kEnough = 2.0 / 3.0;

void CheckBodies(const Points& from,
                 const Points& to,
                 const Faces& faces,
                 const std::string& name) {
  if (from.cols() != to.cols())
    throw InputError(name + ": carried from a body of " +
                     std::to_string(from.cols()) + " vertices to one of " +
                     std::to_string(to.cols()) +
                     ", expected the same body in another shape");
  if (faces.cols() == 0 || faces.minCoeff() < 0 ||
      faces.maxCoeff() >= from.cols())
    throw InputError(name + ": carried to a body whose faces do not fit its " +
                     std::to_string(from.cols()) + " vertices");
}

void CheckResult(const Garment& before,
                 const Garment& after,
                 const Clearance& clearance,
                 const CarryOptions& options,
                 const std::string& name) {
  if (clearance.vertices < kEnough * options.vertex_clearance ||
      clearance.faces < kEnough * options.face_clearance) {
    char text[100];
    std::snprintf(text,
                  sizeof(text),
                  ": does not fit this body, it comes to %.1f mm from the skin",
                  1e3 * std::min(clearance.vertices, clearance.faces));
    throw InputError(name + text);
  }
  const auto crossings = SelfIntersections(after.placed, after.faces);
  if (crossings.size() > SelfIntersections(before.placed, before.faces).size())
    throw InputError(name + ": does not fit this body, faces " +
                     std::to_string(crossings[0][0]) + " and " +
                     std::to_string(crossings[0][1]) + " cross on it");
}

}  // namespace

Points CarryDisplacement(const Points& cloth,
                         const Points& from,
                         const Points& to,
                         const Faces& faces) {
  VectorXd area = VectorXd::Zero(from.cols());
  const VectorXd face_area = FaceAreas(from, faces);
  for (Eigen::Index f = 0; f < faces.cols(); ++f)
    for (int c = 0; c < 3; ++c) area[faces(c, f)] += face_area[f] / 3.0;
  const Points displacement = to - from;
  Points moves(3, cloth.cols());
  ParallelFor(static_cast<int>(cloth.cols()), 1, [&](int i) {
    const Vector3d x = cloth.col(i);
    const VectorXd squared =
        ((from.colwise() - x).colwise().squaredNorm().array() +
         kSpread * kSpread)
            .transpose();
    const VectorXd weight = area.array() / squared.array().square();
    moves.col(i) = displacement * weight / weight.sum();
  });
  return moves;
}

Garment CarryGarment(const Garment& garment,
                     const Points& from,
                     const Points& to,
                     const Faces& faces,
                     const std::string& name,
                     const CarryOptions& options) {
  CheckBodies(from, to, faces, name);
  Garment carried = garment;
  SurfaceIndex skin(from, faces);
  Clearance clearance;
  Points now = from;
  for (int stage = 1; stage <= options.stages; ++stage) {
    const double share = static_cast<double>(stage) / options.stages;
    const Points next = from + share * (to - from);
    carried.placed += CarryDisplacement(carried.placed, now, next, faces);
    skin.Update(next);
    clearance = PushClear(carried.faces,
                          skin,
                          options.vertex_clearance,
                          options.face_clearance,
                          &carried.placed);
    now = next;
  }
  CheckResult(garment, carried, clearance, options, name);
  return carried;
}

}  // namespace invsim
