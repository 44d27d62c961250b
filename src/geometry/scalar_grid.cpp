// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/scalar_grid.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_map>

#include "invsim/base/error.h"
#include "invsim/base/threads.h"

namespace invsim {
namespace {

// The corners of a cube by number, bit 0 along x, 1 along y, 2 along z. Six
// tetrahedra round the diagonal 0-7, each positively oriented.
constexpr int kTetrahedra[6][4] = {{0, 1, 3, 7},
                                   {0, 3, 2, 7},
                                   {0, 2, 6, 7},
                                   {0, 6, 4, 7},
                                   {0, 4, 5, 7},
                                   {0, 5, 1, 7}};

// Even reorderings that put corner a first, or corners a, b first.
constexpr int kFirst[4][4] = {
    {0, 1, 2, 3}, {1, 0, 3, 2}, {2, 0, 1, 3}, {3, 0, 2, 1}};
constexpr int kPair[6][4] = {{0, 1, 2, 3},
                             {0, 2, 3, 1},
                             {0, 3, 1, 2},
                             {1, 2, 0, 3},
                             {1, 3, 2, 0},
                             {2, 3, 0, 1}};

// Crossings keep this fraction of the edge from its ends.
constexpr double kFromNode = 0.1;

class Marcher {
 public:
  explicit Marcher(const ScalarGrid& grid) : grid_(grid) {}

  TriangleMesh Run() {
    const auto& n = grid_.size();
    for (int k = 0; k + 1 < n[2]; ++k)
      for (int j = 0; j + 1 < n[1]; ++j)
        for (int i = 0; i + 1 < n[0]; ++i) Cube(i, j, k);
    TriangleMesh mesh{Points(3, vertices_.size()), Faces(3, faces_.size())};
    for (size_t v = 0; v < vertices_.size(); ++v)
      mesh.vertices.col(v) = vertices_[v];
    for (size_t f = 0; f < faces_.size(); ++f) mesh.faces.col(f) = faces_[f];
    return mesh;
  }

 private:
  void Cube(int i, int j, int k) {
    int inside = 0;
    for (int c = 0; c < 8; ++c) {
      at_[c] = {i + (c & 1), j + ((c >> 1) & 1), k + ((c >> 2) & 1)};
      value_[c] = grid_.value(grid_.Node(at_[c][0], at_[c][1], at_[c][2]));
      inside += value_[c] < 0.0 ? 1 : 0;
    }
    if (inside == 0 || inside == 8) return;
    for (const auto& t : kTetrahedra) Tetrahedron(t);
  }

  void Tetrahedron(const int (&t)[4]) {
    const auto in = [&](int c) { return value_[t[c]] < 0.0; };
    const int inside = in(0) + in(1) + in(2) + in(3);
    if (inside == 1 || inside == 3) {
      for (const auto& p : kFirst) {
        if (in(p[0]) != (inside == 1)) continue;
        const int ab = Crossing(t[p[0]], t[p[1]]);
        const int ac = Crossing(t[p[0]], t[p[2]]);
        const int ad = Crossing(t[p[0]], t[p[3]]);
        if (inside == 1) {
          faces_.emplace_back(ab, ac, ad);
        } else {
          faces_.emplace_back(ab, ad, ac);
        }
      }
    } else if (inside == 2) {
      for (const auto& p : kPair) {
        if (!in(p[0]) || !in(p[1])) continue;
        const int ac = Crossing(t[p[0]], t[p[2]]);
        const int ad = Crossing(t[p[0]], t[p[3]]);
        const int bd = Crossing(t[p[1]], t[p[3]]);
        const int bc = Crossing(t[p[1]], t[p[2]]);
        faces_.emplace_back(ac, ad, bd);
        faces_.emplace_back(ac, bd, bc);
      }
    }
  }

  // The vertex on the edge between two corners of the current cube. Corners of
  // an edge are ordered bitwise, so (lower node, direction) names the edge.
  int Crossing(int c, int d) {
    const int low = c & d, high = c | d;
    const long long key =
        8LL * grid_.Node(at_[low][0], at_[low][1], at_[low][2]) + (low ^ high);
    const auto [it, fresh] =
        number_.try_emplace(key, static_cast<int>(vertices_.size()));
    if (fresh) {
      const double s = std::clamp(value_[low] / (value_[low] - value_[high]),
                                  kFromNode,
                                  1.0 - kFromNode);
      const Vector3d a = Position(low), b = Position(high);
      vertices_.push_back(a + s * (b - a));
    }
    return it->second;
  }
  Vector3d Position(int c) const {
    return grid_.Position(at_[c][0], at_[c][1], at_[c][2]);
  }

  const ScalarGrid& grid_;
  std::array<std::array<int, 3>, 8> at_;
  double value_[8];
  std::unordered_map<long long, int> number_;
  std::vector<Vector3d> vertices_;
  std::vector<Eigen::Vector3i> faces_;
};

}  // namespace

ScalarGrid::ScalarGrid(const Vector3d& low, const Vector3d& high, double cell)
    : low_(low), cell_(cell) {
  double nodes = 1.0;
  for (int c = 0; c < 3; ++c)
    nodes *= std::ceil((high[c] - low[c]) / cell) + 1.0;
  if (!(cell > 0.0) || !((high - low).minCoeff() > 0.0) ||
      !(nodes < static_cast<double>(1 << 28)))
    throw UsageError("grid of cell " + std::to_string(cell) +
                     " m cannot cover its box, expected a positive cell, a "
                     "box of some size and fewer than 2^28 nodes");
  for (int c = 0; c < 3; ++c)
    size_[c] = static_cast<int>(std::ceil((high[c] - low[c]) / cell)) + 1;
  value_.assign(static_cast<size_t>(size_[0]) * size_[1] * size_[2], 0.0);
}

void ScalarGrid::Fill(const std::function<double(const Vector3d&)>& f,
                      double band) {
  constexpr int kBlock = 6;
  constexpr double kSlope = 1.2;
  const double reach = kSlope * cell_ * std::sqrt(3.0) * 0.5 * kBlock + band;
  std::array<int, 3> blocks;
  for (int c = 0; c < 3; ++c) blocks[c] = (size_[c] + kBlock - 1) / kBlock;
  ParallelFor(blocks[0] * blocks[1] * blocks[2], 16, [&](int b) {
    const int first[3] = {kBlock * (b % blocks[0]),
                          kBlock * (b / blocks[0] % blocks[1]),
                          kBlock * (b / (blocks[0] * blocks[1]))};
    const Vector3d middle = Position(first[0], first[1], first[2]) +
                            Vector3d::Constant(0.5 * (kBlock - 1) * cell_);
    const double there = f(middle);
    const bool far = std::abs(there) > reach;
    for (int k = first[2]; k < std::min(first[2] + kBlock, size_[2]); ++k)
      for (int j = first[1]; j < std::min(first[1] + kBlock, size_[1]); ++j)
        for (int i = first[0]; i < std::min(first[0] + kBlock, size_[0]); ++i)
          value_[Node(i, j, k)] = far ? there : f(Position(i, j, k));
  });
}

double ScalarGrid::Sample(const Vector3d& x) const {
  int node[3];
  double t[3];
  for (int c = 0; c < 3; ++c) {
    const double s = std::clamp((x[c] - low_[c]) / cell_, 0.0, size_[c] - 1.0);
    node[c] = std::min(static_cast<int>(s), size_[c] - 2);
    t[c] = s - node[c];
  }
  double sum = 0.0;
  for (int c = 0; c < 8; ++c) {
    const int d[3] = {c & 1, (c >> 1) & 1, (c >> 2) & 1};
    double weight = 1.0;
    for (int a = 0; a < 3; ++a) weight *= d[a] ? t[a] : 1.0 - t[a];
    sum +=
        weight * value_[Node(node[0] + d[0], node[1] + d[1], node[2] + d[2])];
  }
  return sum;
}

Vector3d ScalarGrid::Gradient(const Vector3d& x) const {
  Vector3d g;
  for (int c = 0; c < 3; ++c) {
    const Vector3d h = 0.5 * cell_ * Vector3d::Unit(c);
    g[c] = (Sample(x + h) - Sample(x - h)) / cell_;
  }
  return g;
}

void ScalarGrid::Smooth(double sigma) {
  const int reach = static_cast<int>(std::ceil(3.0 * sigma / cell_));
  if (reach == 0) return;
  std::vector<double> kernel(2 * reach + 1);
  double sum = 0.0;
  for (int r = -reach; r <= reach; ++r) {
    const double u = r * cell_ / sigma;
    sum += kernel[r + reach] = std::exp(-0.5 * u * u);
  }
  for (double& k : kernel) k /= sum;
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<double> old = value_;
    const int stride = axis == 0   ? 1
                       : axis == 1 ? size_[0]
                                   : size_[0] * size_[1];
    ParallelFor(num_nodes(), 1024, [&](int node) {
      const int at = node / stride % size_[axis];
      double smooth = 0.0;
      for (int r = -reach; r <= reach; ++r) {
        const int to = std::clamp(at + r, 0, size_[axis] - 1);
        smooth += kernel[r + reach] * old[node + (to - at) * stride];
      }
      value_[node] = smooth;
    });
  }
}

TriangleMesh ZeroSurface(const ScalarGrid& grid) { return Marcher(grid).Run(); }

}  // namespace invsim
