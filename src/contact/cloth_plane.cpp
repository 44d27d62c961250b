// SPDX-License-Identifier: Apache-2.0
#include <ceres/jet.h>

#include <Eigen/Geometry>
#include <cmath>

#include "invsim/contact/cloth_contact.h"

namespace invsim {
namespace {

template <typename T>
using Vector3 = Eigen::Matrix<T, 3, 1>;
template <typename T>
using Corner4 = Eigen::Matrix<T, 3, 4>;

template <typename T>
struct SelfPlane {
  Vector3<T> normal, velocity;
  Eigen::Matrix<T, 4, 1> weights;
  T distance;
};

// The nearest points of the lines and planes of the feature, not clamped to
// it, as weights; `normal` only of faces and edge pairs, not of length one.
template <typename T>
void Weigh(PairFeature feature,
           const Corner4<T>& x,
           Eigen::Matrix<T, 4, 1>* weights,
           Vector3<T>* normal) {
  auto& w = *weights;
  switch (feature) {
    case PairFeature::kVertexVertex:
      w << T(1), T(-1), T(0), T(0);
      break;
    case PairFeature::kVertexEdge: {
      const Vector3<T> e = x.col(2) - x.col(1);
      const T t = e.dot(x.col(0) - x.col(1)) / e.squaredNorm();
      w << T(1), t - T(1), -t, T(0);
      break;
    }
    case PairFeature::kVertexFace: {
      const Vector3<T> e1 = x.col(2) - x.col(1), e2 = x.col(3) - x.col(1);
      const Vector3<T> q = x.col(0) - x.col(1);
      *normal = e1.cross(e2);
      const T nn = normal->squaredNorm();
      const T w1 = normal->dot(q.cross(e2)) / nn;
      const T w2 = normal->dot(e1.cross(q)) / nn;
      w << T(1), w1 + w2 - T(1), -w1, -w2;
      break;
    }
    case PairFeature::kEdgeEdge: {
      const Vector3<T> d = x.col(1) - x.col(0), e = x.col(3) - x.col(2);
      const Vector3<T> r = x.col(0) - x.col(2);
      *normal = d.cross(e);
      const T dd = d.squaredNorm(), ee = e.squaredNorm(), de = d.dot(e);
      const T determinant = normal->squaredNorm();
      const T s = (de * e.dot(r) - ee * d.dot(r)) / determinant;
      const T t = (dd * e.dot(r) - de * d.dot(r)) / determinant;
      w << T(1) - s, s, t - T(1), -t;
      break;
    }
  }
}

template <typename T>
SelfPlane<T> EvaluateSelfPlane(const SelfContactOptions& options,
                               double dt,
                               const ClothContact& contact,
                               const Corner4<T>& x) {
  SelfPlane<T> plane;
  Vector3<T> normal;
  Weigh(contact.feature, x, &plane.weights, &normal);
  const Vector3<T> offset = x * plane.weights;
  if (contact.feature == PairFeature::kVertexFace ||
      contact.feature == PairFeature::kEdgeEdge) {
    plane.normal = normal * (T(contact.side) / sqrt(normal.squaredNorm()));
    plane.distance = plane.normal.dot(offset);
  } else {
    plane.distance = sqrt(offset.squaredNorm());
    plane.normal = offset / plane.distance;
  }
  T approach = (contact.thickness - plane.distance) / dt;
  if (approach > options.recovery_speed) approach = T(options.recovery_speed);
  plane.velocity = approach * plane.normal;
  return plane;
}

}  // namespace

ClothPlane EvaluateClothPlane(const SelfContactOptions& options,
                              double dt,
                              const ClothContact& contact,
                              const PairPoints& x) {
  const SelfPlane<double> plane =
      EvaluateSelfPlane<double>(options, dt, contact, x);
  return {plane.normal, plane.velocity, plane.weights, plane.distance};
}

ClothPlaneJacobian DifferentiateClothPlane(const SelfContactOptions& options,
                                           double dt,
                                           const ClothContact& contact,
                                           const PairPoints& x) {
  using Jet = ceres::Jet<double, 12>;
  Corner4<Jet> corners;
  for (int k = 0; k < 4; ++k)
    for (int c = 0; c < 3; ++c) corners(c, k) = Jet(x(c, k), 3 * k + c);
  const SelfPlane<Jet> plane =
      EvaluateSelfPlane<Jet>(options, dt, contact, corners);
  ClothPlaneJacobian jacobian;
  for (int c = 0; c < 3; ++c) {
    jacobian.row(c) = plane.normal[c].v.transpose();
    jacobian.row(3 + c) = plane.velocity[c].v.transpose();
  }
  for (int k = 0; k < 4; ++k)
    jacobian.row(6 + k) = plane.weights[k].v.transpose();
  return jacobian;
}

}  // namespace invsim
