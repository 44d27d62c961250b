// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/chamfer.h"

#include <cmath>

namespace invsim {

VectorXd DistancesToPoints(const Points& from, const KdTree& to) {
  const auto nearest = to.NearestAll(from);
  VectorXd r(from.cols());
  for (Eigen::Index i = 0; i < r.size(); ++i)
    r[i] = std::sqrt(nearest[i].squared_distance);
  return r;
}

VectorXd DistancesToSurface(const Points& from, const SurfaceIndex& to) {
  const auto nearest = to.NearestAll(from);
  VectorXd r(from.cols());
  for (Eigen::Index i = 0; i < r.size(); ++i) r[i] = nearest[i].distance;
  return r;
}

ChamferDistance Chamfer(const Points& a, const Points& b) {
  const KdTree tree_a(a), tree_b(b);
  return {DistancesToPoints(a, tree_b).mean(),
          DistancesToPoints(b, tree_a).mean()};
}

}  // namespace invsim
