// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/point_normals.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "invsim/base/threads.h"

namespace invsim {

Points EstimateNormals(const KdTree& points, int neighbours) {
  const Points& all = points.points();
  const int n = static_cast<int>(all.cols());
  const int k = std::min(neighbours, n);
  Points normals(3, n);
  ParallelFor(n, 64, [&](int i) {
    Points near(3, k);
    const std::vector<Neighbour> found = points.NearestK(all.col(i), k);
    for (int j = 0; j < k; ++j) near.col(j) = all.col(found[j].index);
    near.colwise() -= near.rowwise().mean().eval();
    Eigen::SelfAdjointEigenSolver<Matrix3d> eigen;
    eigen.compute(near * near.transpose());
    normals.col(i) = eigen.eigenvectors().col(0);
  });
  return normals;
}

}  // namespace invsim
