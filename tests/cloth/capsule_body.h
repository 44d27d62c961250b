// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_TESTS_CLOTH_CAPSULE_BODY_H_
#define INVSIM_TESTS_CLOTH_CAPSULE_BODY_H_

// A body of capsules in the T-pose with SMPL's joints, for tests that dress
// somebody without needing a body model.

#include <algorithm>
#include <vector>

#include "invsim/cloth/tpose_body.h"
#include "invsim/geometry/closest_point.h"
#include "invsim/geometry/remesh.h"
#include "invsim/geometry/scalar_grid.h"

namespace invsim {

struct Capsule {
  Vector3d a, b;
  double radius;
  int joint;
};

inline std::vector<Capsule> CapsulesOf(const Points& j) {
  std::vector<Capsule> c;
  const auto add = [&](const Vector3d& a, const Vector3d& b, double r, int k) {
    c.push_back({a, b, r, k});
  };
  const Vector3d up(0, 0.05, 0);
  add(j.col(12) - up, j.col(15), 0.055, 12);
  add(j.col(15), j.col(15) + 2 * up, 0.085, 15);
  for (int s = 0; s < 2; ++s) {
    const double side = s == 0 ? 1.0 : -1.0;
    add(Vector3d(0.07 * side, 0.16, 0),
        Vector3d(0.05 * side, -0.05, 0),
        0.09,
        9);
    add(Vector3d(0.05 * side, -0.05, 0),
        Vector3d(0.08 * side, -0.2, 0),
        0.1,
        0);
    add(j.col(13 + s), j.col(16 + s), 0.06, 13 + s);
    add(j.col(16 + s), j.col(18 + s), 0.05, 16 + s);
    add(j.col(18 + s), j.col(20 + s), 0.04, 18 + s);
    add(j.col(20 + s), j.col(22 + s), 0.03, 20 + s);
    add(j.col(1 + s), j.col(4 + s), 0.075, 1 + s);
    add(j.col(4 + s), j.col(7 + s), 0.055, 4 + s);
    add(j.col(7 + s), j.col(10 + s), 0.04, 7 + s);
  }
  return c;
}

inline Points CapsuleJoints() {
  Points j(3, 24);
  j << 0, 0.1, -0.1, 0, 0.12, -0.12, 0, 0.14, -0.14, 0, 0.14, -0.14, 0, 0.05,
      -0.05, 0, 0.17, -0.17, 0.42, -0.42, 0.65, -0.65, 0.75, -0.75,  //
      -0.2, -0.22, -0.22, -0.12, -0.6, -0.6, -0.05, -1.02, -1.02, 0.02, -1.05,
      -1.05, 0.33, 0.25, 0.25, 0.43, 0.25, 0.25, 0.24, 0.24, 0.24, 0.24, 0.24,
      0.24,  //
      0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.1, 0.1, 0, 0, 0, 0.02, 0, 0, 0, 0, 0, 0,
      0, 0;
  return j;
}

inline double DistanceTo(const Capsule& c, const Vector3d& x) {
  const double t = ClosestPointOnSegment(x, c.a, c.b);
  return (x - c.a - t * (c.b - c.a)).norm() - c.radius;
}

inline TPoseBody CapsuleBody() {
  TPoseBody body;
  body.joints = CapsuleJoints();
  const std::vector<Capsule> capsules = CapsulesOf(body.joints);
  ScalarGrid grid(
      Vector3d(-0.85, -1.15, -0.2), Vector3d(0.85, 0.7, 0.25), 0.016);
  grid.Fill(
      [&](const Vector3d& x) {
        double value = 1.0;
        for (const Capsule& c : capsules)
          value = std::min(value, DistanceTo(c, x));
        return value;
      },
      0.1);
  grid.Smooth(0.016);
  const TriangleMesh mesh = Remesh(ZeroSurface(grid), 0.03);
  body.vertices = mesh.vertices;
  body.faces = mesh.faces;
  body.weights = MatrixXd::Zero(mesh.vertices.cols(), 24);
  for (int v = 0; v < mesh.vertices.cols(); ++v) {
    const auto nearest = std::min_element(
        capsules.begin(),
        capsules.end(),
        [x = Vector3d(mesh.vertices.col(v))](const auto& p, const auto& q) {
          return DistanceTo(p, x) < DistanceTo(q, x);
        });
    body.weights(v, nearest->joint) = 1.0;
  }
  return body;
}

}  // namespace invsim

#endif  // INVSIM_TESTS_CLOTH_CAPSULE_BODY_H_
