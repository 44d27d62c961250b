// SPDX-License-Identifier: Apache-2.0
#include "mannequin_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "invsim/base/threads.h"
#include "invsim/geometry/remesh.h"
#include "invsim/geometry/scalar_grid.h"
#include "invsim/geometry/topology.h"
#include "mannequin_solid.h"
#include "smooth_step.h"

namespace invsim {
namespace {

// Metres. The cubes of the grid are smaller than the smallest triangles; its
// box holds the left half.
constexpr double kCell = 0.009;
const Vector3d kLow(0.0, -1.125, -0.15);
const Vector3d kHigh(0.90, 0.62, 0.19);
// The solid's "distance" is at most this many times the distance.
constexpr double kSteepest = 2.0;
constexpr int kGridBlock = 8;

// Nodes are evaluated in blocks; one that the surface cannot reach needs only
// its sign.
void SampleBlock(const std::array<int, 3>& first, ScalarGrid* grid) {
  std::array<int, 3> end;
  for (int c = 0; c < 3; ++c) {
    end[c] = std::min(first[c] + kGridBlock, grid->size()[c]);
  }
  const Vector3d low = grid->Position(first[0], first[1], first[2]);
  const Vector3d high = grid->Position(end[0], end[1], end[2]);
  const double centre = MannequinDistance(0.5 * (low + high));
  // Its neighbours' cubes reach one node into a block.
  const double reach = 0.5 * (high - low).norm() + 2.0 * grid->cell();
  const bool empty = std::abs(centre) > kSteepest * reach;
  for (int k = first[2]; k < end[2]; ++k) {
    for (int j = first[1]; j < end[1]; ++j) {
      for (int i = first[0]; i < end[0]; ++i) {
        grid->value(grid->Node(i, j, k)) =
            empty ? centre : MannequinDistance(grid->Position(i, j, k));
      }
    }
  }
}

ScalarGrid SampleLeftHalf() {
  ScalarGrid grid(kLow, kHigh, kCell);
  const std::array<int, 3>& n = grid.size();
  ParallelFor((n[2] + kGridBlock - 1) / kGridBlock, 1, [&](int k) {
    for (int j = 0; j < n[1]; j += kGridBlock) {
      for (int i = 0; i < n[0]; i += kGridBlock) {
        SampleBlock({i, j, k * kGridBlock}, &grid);
      }
    }
  });
  return grid;
}

// From `fine` within the radius of a point to `coarse` beyond twice that.
double Near(const Vector3d& x,
            const Vector3d& centre,
            double radius,
            double fine,
            double coarse) {
  const double t = SmoothStep(radius, 2.0 * radius, (x - centre).norm());
  return fine + t * (coarse - fine);
}

double WantedEdge(const Vector3d& x) {
  constexpr double kCoarse = 0.028;
  const double hand = SmoothStep(0.64, 0.71, x.x());
  const double foot = SmoothStep(-0.95, -1.03, x.y());
  const double head = SmoothStep(0.31, 0.38, x.y());
  return std::min({kCoarse - hand * (kCoarse - 0.013),
                   kCoarse - foot * (kCoarse - 0.016),
                   kCoarse - head * (kCoarse - 0.016),
                   Near(x, {0.785, 0.239, 0.068}, 0.03, 0.010, kCoarse),
                   Near(x, {0.0, 0.475, 0.095}, 0.02, 0.010, kCoarse),
                   Near(x, {0.078, 0.486, -0.01}, 0.025, 0.010, kCoarse),
                   Near(x, {0.0, -0.335, 0.0}, 0.05, 0.020, kCoarse)});
}

// Newton steps along the gradient, taken by differences. The middle stays in
// the middle.
Vector3d OnSolid(Vector3d x) {
  constexpr double kStep = 1e-5;
  for (int iteration = 0; iteration < 3; ++iteration) {
    Vector3d gradient;
    for (int c = 0; c < 3; ++c) {
      const Vector3d step = kStep * Vector3d::Unit(c);
      gradient[c] =
          (MannequinDistance(x + step) - MannequinDistance(x - step)) /
          (2.0 * kStep);
    }
    if (x.x() == 0.0) gradient.x() = 0.0;
    x -= MannequinDistance(x) / gradient.squaredNorm() * gradient;
  }
  return x;
}

}  // namespace

MirrorMesh JoinWithMirrorImage(const TriangleMesh& half) {
  const auto n = static_cast<int>(half.vertices.cols());
  MirrorMesh result;
  result.mirror.resize(n);
  int count = n;
  for (int i = 0; i < n; ++i) {
    result.mirror[i] = half.vertices(0, i) == 0.0 ? i : count++;
  }
  result.mesh.vertices.resize(3, count);
  result.mesh.vertices.leftCols(n) = half.vertices;
  result.mirror.resize(count);
  for (int i = 0; i < n; ++i) {
    const int j = result.mirror[i];
    if (j == i) continue;
    result.mesh.vertices.col(j) =
        half.vertices.col(i).cwiseProduct(Vector3d(-1, 1, 1));
    result.mirror[j] = i;
  }
  const Eigen::Index faces = half.faces.cols();
  result.mesh.faces.resize(3, 2 * faces);
  result.mesh.faces.leftCols(faces) = half.faces;
  for (Eigen::Index f = 0; f < faces; ++f) {
    const auto face = half.faces.col(f);
    result.mesh.faces.col(faces + f) << result.mirror[face[0]],
        result.mirror[face[2]], result.mirror[face[1]];
  }
  return result;
}

MirrorMesh MakeMannequinMesh() {
  TriangleMesh fine = ZeroSurface(SampleLeftHalf());
  // On the boundary alone: the remesher takes the turns of the zigzag that
  // marching leaves there for corners.
  for (const std::vector<int>& loop : BoundaryLoops(fine.faces)) {
    for (const int v : loop)
      fine.vertices.col(v) = OnSolid(fine.vertices.col(v));
  }
  TriangleMesh half = Remesh(fine, WantedEdge);
  for (Eigen::Index i = 0; i < half.vertices.cols(); ++i) {
    half.vertices.col(i) = OnSolid(half.vertices.col(i));
  }
  return JoinWithMirrorImage(half);
}

}  // namespace invsim
