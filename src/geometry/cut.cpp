// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/cut.h"

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "invsim/base/error.h"
#include "invsim/geometry/closest_point.h"
#include "invsim/geometry/topology.h"

namespace invsim {
namespace {

// Crossings keep this fraction of the edge from its ends.
constexpr double kFromEnd = 0.1;

// The mesh of some faces, without the vertices they do not use.
TriangleMesh Used(const std::vector<Vector3d>& x,
                  const std::vector<Eigen::Vector3i>& faces) {
  std::vector<int> number(x.size(), -1);
  for (const auto& f : faces)
    for (int c = 0; c < 3; ++c) number[f[c]] = 0;
  int count = 0;
  for (int& n : number)
    if (n == 0) n = count++;
  TriangleMesh mesh{Points(3, count), Faces(3, faces.size())};
  for (size_t v = 0; v < x.size(); ++v)
    if (number[v] >= 0) mesh.vertices.col(number[v]) = x[v];
  for (size_t f = 0; f < faces.size(); ++f)
    for (int c = 0; c < 3; ++c) mesh.faces(c, f) = number[faces[f][c]];
  return mesh;
}

}  // namespace

TriangleMesh CutMesh(const TriangleMesh& mesh, const VectorXd& values) {
  if (values.size() != mesh.vertices.cols())
    throw InputError(std::to_string(values.size()) +
                     " values to cut by, expected one for each of " +
                     std::to_string(mesh.vertices.cols()) + " vertices");
  std::vector<Vector3d> x(mesh.vertices.cols());
  for (size_t v = 0; v < x.size(); ++v) x[v] = mesh.vertices.col(v);
  std::map<std::pair<int, int>, int> crossings;
  const auto crossing = [&](int a, int b) {
    if (a > b) std::swap(a, b);
    const auto [it, fresh] =
        crossings.try_emplace({a, b}, static_cast<int>(x.size()));
    if (fresh) {
      const double t = std::clamp(
          values[a] / (values[a] - values[b]), kFromEnd, 1.0 - kFromEnd);
      const Vector3d p = x[a] + t * (x[b] - x[a]);
      x.push_back(p);
    }
    return it->second;
  };
  std::vector<Eigen::Vector3i> faces;
  for (Eigen::Index f = 0; f < mesh.faces.cols(); ++f) {
    std::vector<int> kept;  // the corners of what is left, in order
    for (int c = 0; c < 3; ++c) {
      const int v = mesh.faces(c, f), w = mesh.faces((c + 1) % 3, f);
      if (values[v] >= 0.0) kept.push_back(v);
      if ((values[v] >= 0.0) != (values[w] >= 0.0))
        kept.push_back(crossing(v, w));
    }
    if (kept.size() >= 3) faces.emplace_back(kept[0], kept[1], kept[2]);
    if (kept.size() == 4) faces.emplace_back(kept[0], kept[2], kept[3]);
  }
  return Used(x, faces);
}

TriangleMesh PieceNearest(const TriangleMesh& mesh, const Vector3d& point) {
  const std::vector<int> piece =
      VertexComponents(mesh.faces, static_cast<int>(mesh.vertices.cols()));
  double best = std::numeric_limits<double>::infinity();
  int chosen = -1;
  for (Eigen::Index f = 0; f < mesh.faces.cols(); ++f) {
    const double squared =
        ClosestPointOnTriangle(point,
                               mesh.vertices.col(mesh.faces(0, f)),
                               mesh.vertices.col(mesh.faces(1, f)),
                               mesh.vertices.col(mesh.faces(2, f)))
            .squared_distance;
    if (squared >= best) continue;
    best = squared;
    chosen = piece[mesh.faces(0, f)];
  }
  std::vector<Vector3d> x(mesh.vertices.cols());
  for (size_t v = 0; v < x.size(); ++v) x[v] = mesh.vertices.col(v);
  std::vector<Eigen::Vector3i> faces;
  for (Eigen::Index f = 0; f < mesh.faces.cols(); ++f)
    if (piece[mesh.faces(0, f)] == chosen) faces.push_back(mesh.faces.col(f));
  return Used(x, faces);
}

}  // namespace invsim
