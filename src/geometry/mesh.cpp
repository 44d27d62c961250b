// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "invsim/base/error.h"

namespace invsim {
namespace {

// Twice the area times the unit normal.
Vector3d AreaVector(const Points& x, const Faces& faces, Eigen::Index f) {
  const Vector3d a = x.col(faces(0, f));
  return (x.col(faces(1, f)) - a).cross(x.col(faces(2, f)) - a);
}

// Zero stays zero: `normalized()` would leave a denormal vector as it is.
Vector3d UnitOrZero(const Vector3d& v) {
  const double length = v.stableNorm();
  return length > 0.0 ? Vector3d(v / length) : Vector3d::Zero();
}

// One side of one face, as a directed edge.
struct HalfEdge {
  int a, b;  // a < b
  int face;
  int opposite;
  bool forward;  // runs a -> b on its face
};

std::vector<HalfEdge> SortedHalfEdges(const Faces& faces) {
  std::vector<HalfEdge> half;
  half.reserve(3 * static_cast<size_t>(faces.cols()));
  for (int f = 0; f < faces.cols(); ++f) {
    for (int c = 0; c < 3; ++c) {
      const int from = faces(c, f), to = faces((c + 1) % 3, f);
      half.push_back({std::min(from, to),
                      std::max(from, to),
                      f,
                      faces((c + 2) % 3, f),
                      from < to});
    }
  }
  std::sort(half.begin(), half.end(), [](const auto& p, const auto& q) {
    return std::tie(p.a, p.b, p.face) < std::tie(q.a, q.b, q.face);
  });
  return half;
}

std::string EdgeName(const HalfEdge& h) {
  return "edge (" + std::to_string(h.a) + ", " + std::to_string(h.b) + ")";
}

}  // namespace

Points FaceNormals(const Points& vertices, const Faces& faces) {
  Points normals(3, faces.cols());
  for (Eigen::Index f = 0; f < faces.cols(); ++f)
    normals.col(f) = UnitOrZero(AreaVector(vertices, faces, f));
  return normals;
}

VectorXd FaceAreas(const Points& vertices, const Faces& faces) {
  VectorXd areas(faces.cols());
  for (Eigen::Index f = 0; f < faces.cols(); ++f)
    areas[f] = 0.5 * AreaVector(vertices, faces, f).stableNorm();
  return areas;
}

Points VertexNormals(const Points& vertices, const Faces& faces) {
  Points sum = Points::Zero(3, vertices.cols());
  for (Eigen::Index f = 0; f < faces.cols(); ++f) {
    const Vector3d normal = UnitOrZero(AreaVector(vertices, faces, f));
    for (int c = 0; c < 3; ++c)
      sum.col(faces(c, f)) += CornerAngle(vertices, faces, f, c) * normal;
  }
  for (Eigen::Index i = 0; i < sum.cols(); ++i)
    sum.col(i) = UnitOrZero(sum.col(i));
  return sum;
}

double CornerAngle(const Points& vertices,
                   const Faces& faces,
                   Eigen::Index face,
                   int corner) {
  const Vector3d a = vertices.col(faces(corner, face));
  const Vector3d u = vertices.col(faces((corner + 1) % 3, face)) - a;
  const Vector3d v = vertices.col(faces((corner + 2) % 3, face)) - a;
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

std::vector<Edge> Edges(const Faces& faces) {
  const std::vector<HalfEdge> half = SortedHalfEdges(faces);
  std::vector<Edge> edges;
  edges.reserve(half.size() / 2 + 1);
  for (size_t i = 0; i < half.size();) {
    size_t end = i + 1;
    while (end < half.size() && half[end].a == half[i].a &&
           half[end].b == half[i].b)
      ++end;
    const HalfEdge& h = half[i];
    if (h.a == h.b)
      throw InputError("face " + std::to_string(h.face) + " has vertex " +
                       std::to_string(h.a) + " twice");
    if (end - i > 2)
      throw InputError(EdgeName(h) + " has " + std::to_string(end - i) +
                       " faces, expected at most 2");
    if (end - i == 2 && half[i + 1].forward == h.forward)
      throw InputError(EdgeName(h) + " runs the same way on faces " +
                       std::to_string(h.face) + " and " +
                       std::to_string(half[i + 1].face) +
                       ", expected opposite ways");
    Edge e{h.a, h.b, {h.face, -1}, {h.opposite, -1}};
    if (end - i == 2) {
      e.faces[1] = half[i + 1].face;
      e.opposite[1] = half[i + 1].opposite;
      if (!h.forward) {
        std::swap(e.faces[0], e.faces[1]);
        std::swap(e.opposite[0], e.opposite[1]);
      }
    }
    edges.push_back(e);
    i = end;
  }
  return edges;
}

}  // namespace invsim
