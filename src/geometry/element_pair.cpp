// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/element_pair.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "invsim/geometry/closest_point.h"

namespace invsim {
namespace {

// Time goes on by this share of what is safe, and stops when no more than this
// much of the gap is left.
constexpr double kShare = 0.9;
constexpr double kLeft = 1e-4;
// Advances before a pair that slides along within the gap's reach is given up
// as touching.
constexpr int kMostAdvances = 500;

// Lines closer to parallel than this (sine squared) are handled by their ends.
constexpr double kParallel = 1e-12;

NearestPoints FromWeights(const PairPoints& x, const Eigen::Vector4d& weights) {
  const Vector3d offset = x * weights;
  return {weights, offset, offset.norm()};
}

NearestPoints VertexFace(const PairPoints& x) {
  const ClosestPoint p =
      ClosestPointOnTriangle(x.col(0), x.col(1), x.col(2), x.col(3));
  return FromWeights(x, {1, -p.weights[0], -p.weights[1], -p.weights[2]});
}

// The nearest of the ends' own nearest points, unless the lines are nearest
// within both edges.
NearestPoints EdgeEdge(const PairPoints& x) {
  const Vector3d d = x.col(1) - x.col(0), e = x.col(3) - x.col(2);
  const Vector3d r = x.col(0) - x.col(2);
  const double dd = d.squaredNorm(), ee = e.squaredNorm(), de = d.dot(e);
  const double determinant = d.cross(e).squaredNorm();
  if (determinant > kParallel * dd * ee) {
    const double s = (de * e.dot(r) - ee * d.dot(r)) / determinant;
    const double t = (dd * e.dot(r) - de * d.dot(r)) / determinant;
    if (s > 0 && s < 1 && t > 0 && t < 1)
      return FromWeights(x, {1 - s, s, t - 1, -t});
  }
  NearestPoints best;
  best.distance = std::numeric_limits<double>::infinity();
  for (int end = 0; end < 2; ++end) {
    const double t = ClosestPointOnSegment(x.col(end), x.col(2), x.col(3));
    const double s = ClosestPointOnSegment(x.col(2 + end), x.col(0), x.col(1));
    const NearestPoints first =
        FromWeights(x, {1.0 - end, static_cast<double>(end), t - 1, -t});
    const NearestPoints second =
        FromWeights(x, {1 - s, s, end - 1.0, -static_cast<double>(end)});
    if (first.distance < best.distance) best = first;
    if (second.distance < best.distance) best = second;
  }
  return best;
}

}  // namespace

PairPoints Corners(const Points& x, const ElementPair& pair) {
  PairPoints corners;
  for (int k = 0; k < 4; ++k) corners.col(k) = x.col(pair.vertex[k]);
  return corners;
}

NearestPoints Nearest(PairKind kind, const PairPoints& x) {
  return kind == PairKind::kVertexFace ? VertexFace(x) : EdgeEdge(x);
}

double FirstTimeWithin(double gap,
                       PairKind kind,
                       const PairPoints& x0,
                       const PairPoints& x1) {
  PairPoints move = x1 - x0;
  move.colwise() -= move.rowwise().mean().eval();
  const Eigen::RowVector4d length = move.colwise().norm();
  const double reach =
      kind == PairKind::kVertexFace
          ? length[0] + length.tail<3>().maxCoeff()
          : length.head<2>().maxCoeff() + length.tail<2>().maxCoeff();
  double t = 0;
  for (int k = 0; k < kMostAdvances; ++k) {
    const double left = Nearest(kind, x0 + t * move).distance - gap;
    if (left <= kLeft * gap) return t;
    if (left >= (1 - t) * reach) return kNever;
    t += kShare * left / reach;
  }
  return t;
}

}  // namespace invsim
