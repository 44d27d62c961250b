// SPDX-License-Identifier: Apache-2.0
#include <ceres/jet.h>

#include <Eigen/Geometry>
#include <cmath>

#include "invsim/contact/body_contact.h"

namespace invsim {
namespace {

template <typename T>
using Vector3 = Eigen::Matrix<T, 3, 1>;
template <typename T>
using Matrix3 = Eigen::Matrix<T, 3, 3>;

template <typename T>
struct BodyPlane {
  Vector3<T> normal;
  Vector3<T> velocity;
  T distance;
};

// Barycentric weights of the point closest to q on the plane of the face, the
// line of the edge or the vertex; not clamped to the feature.
template <typename T>
Vector3<T> FeatureWeights(const Vector3<T>& q,
                          const Matrix3<T>& p,
                          TriangleFeature feature) {
  Vector3<T> weights(T(0), T(0), T(0));
  const int corner = FeatureCorner(feature);
  if (IsVertex(feature)) {
    weights[corner] = T(1);
  } else if (IsEdge(feature)) {
    const int i = (corner + 1) % 3, j = (corner + 2) % 3;
    const Vector3<T> e = p.col(j) - p.col(i);
    weights[j] = e.dot(q - p.col(i)) / e.squaredNorm();
    weights[i] = T(1) - weights[j];
  } else {
    const Vector3<T> a = p.col(0);
    const Vector3<T> e1 = p.col(1) - a, e2 = p.col(2) - a;
    const Vector3<T> n = e1.cross(e2);
    const T nn = n.squaredNorm();
    weights[1] = n.dot((q - a).cross(e2)) / nn;
    weights[2] = n.dot(e1.cross(q - a)) / nn;
    weights[0] = T(1) - weights[1] - weights[2];
  }
  return weights;
}

template <typename T>
BodyPlane<T> EvaluateBodyPlane(const BodyContactOptions& options,
                               double dt,
                               TriangleFeature feature,
                               double side,
                               const Vector3<T>& x0,
                               const Matrix3<T>& p0,
                               const Matrix3<T>& p1) {
  BodyPlane<T> plane;
  const Vector3<T> b = FeatureWeights(x0, p0, feature);
  const Vector3<T> displacement = (p1 - p0) * b;
  const Vector3<T> carried = x0 + displacement;
  const Vector3<T> y = p1 * FeatureWeights(carried, p1, feature);
  const Vector3<T> offset = carried - y;
  if (feature == TriangleFeature::kFace) {
    plane.normal = (p1.col(1) - p1.col(0)).cross(p1.col(2) - p1.col(0));
    plane.normal = plane.normal / sqrt(plane.normal.squaredNorm());
    plane.distance = plane.normal.dot(offset);
  } else {
    plane.distance = side * sqrt(offset.squaredNorm());
    plane.normal = offset / plane.distance;
  }
  T approach = (options.thickness - plane.distance) / dt;
  if (approach > options.recovery_speed) approach = T(options.recovery_speed);
  plane.velocity = displacement / dt + approach * plane.normal;
  return plane;
}

}  // namespace

ContactPlane EvaluateContactPlane(const BodyContactOptions& options,
                                  double dt,
                                  TriangleFeature feature,
                                  double side,
                                  const Vector3d& x0,
                                  const Matrix3d& corners0,
                                  const Matrix3d& corners1) {
  const BodyPlane<double> plane = EvaluateBodyPlane<double>(
      options, dt, feature, side, x0, corners0, corners1);
  return {plane.normal, plane.velocity, plane.distance};
}

ContactPlaneJacobian DifferentiateContactPlane(
    const BodyContactOptions& options,
    double dt,
    TriangleFeature feature,
    double side,
    const Vector3d& x0,
    const Matrix3d& corners0,
    const Matrix3d& corners1) {
  using Jet = ceres::Jet<double, 21>;
  Vector3<Jet> x;
  Matrix3<Jet> p0, p1;
  for (int c = 0; c < 3; ++c) x[c] = Jet(x0[c], c);
  for (int k = 0; k < 3; ++k) {
    for (int c = 0; c < 3; ++c) {
      p0(c, k) = Jet(corners0(c, k), 3 + 3 * k + c);
      p1(c, k) = Jet(corners1(c, k), 12 + 3 * k + c);
    }
  }
  const BodyPlane<Jet> plane =
      EvaluateBodyPlane<Jet>(options, dt, feature, side, x, p0, p1);
  ContactPlaneJacobian jacobian;
  for (int c = 0; c < 3; ++c) {
    jacobian.row(c) = plane.normal[c].v.transpose();
    jacobian.row(3 + c) = plane.velocity[c].v.transpose();
  }
  return jacobian;
}

}  // namespace invsim
