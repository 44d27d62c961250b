// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_GEOMETRY_SCALAR_GRID_H_
#define INVSIM_GEOMETRY_SCALAR_GRID_H_

// A scalar field sampled on a regular grid of cubes, and the surface on which
// it is zero. Solids are modelled as fields that are negative inside: union is
// the minimum, an offset is a difference.

#include <array>
#include <functional>
#include <vector>

#include "invsim/base/types.h"
#include "invsim/geometry/mesh.h"

namespace invsim {

class ScalarGrid {
 public:
  // Nodes at low + cell (i, j, k), as many as cover the box up to `high`; all
  // zero. Throws UsageError unless the box is not empty, cell > 0 and there
  // are fewer than 2^28 nodes.
  ScalarGrid(const Vector3d& low, const Vector3d& high, double cell);

  double cell() const { return cell_; }
  // Nodes along each axis.
  const std::array<int, 3>& size() const { return size_; }
  int num_nodes() const { return static_cast<int>(value_.size()); }

  int Node(int i, int j, int k) const {
    return i + size_[0] * (j + size_[1] * k);
  }
  Vector3d Position(int i, int j, int k) const {
    return low_ + cell_ * Vector3d(i, j, k);
  }
  double& value(int node) { return value_[node]; }
  double value(int node) const { return value_[node]; }

  // Samples f, threaded, where it is within `band` of zero at least; elsewhere
  // only its sign is right. f must not change faster than distance does, up to
  // a fifth more: blocks of nodes whose middle is too far from zero for the
  // band to reach them are filled with the value there. f is called from
  // several threads at once.
  void Fill(const std::function<double(const Vector3d&)>& f, double band);

  // Trilinear interpolation; outside the box that of the nearest point of it.
  double Sample(const Vector3d& x) const;
  // The gradient of the samples, by central differences over one cell.
  Vector3d Gradient(const Vector3d& x) const;

  // Convolution with a Gaussian of standard deviation sigma (metres), cut off
  // at three sigma; values beyond the box are those on its border.
  void Smooth(double sigma);

 private:
  Vector3d low_;
  double cell_;
  std::array<int, 3> size_;
  std::vector<double> value_;
};

// The surface where the field is zero, facing the positive side, by marching
// tetrahedra: each cube is cut into the six tetrahedra round its diagonal, in
// which the field is linear. It is a manifold, and closed except where it runs
// into the side of the box. Zero values count as positive. Crossings within a
// tenth of an edge's length of a node are moved to a tenth, so that no face is
// degenerate.
TriangleMesh ZeroSurface(const ScalarGrid& grid);

}  // namespace invsim

#endif  // INVSIM_GEOMETRY_SCALAR_GRID_H_
