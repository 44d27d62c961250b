// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/garment.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "invsim/base/error.h"
#include "invsim/geometry/mesh.h"
#include "invsim/geometry/topology.h"
#include "invsim/io/file.h"
#include "invsim/io/obj.h"

namespace invsim {
namespace {

// Metres across that a worn garment, or a test patch, may have.
constexpr double kSmallest = 0.02;
constexpr double kLargest = 5.0;
// How much longer or shorter than in the pattern the typical placed edge may
// be: worn cloth stretches by tenths, a wrong unit makes it ten times or more.
constexpr double kScale = 2.0;
// Twice the area over the longest side squared, below which a pattern
// triangle has no area.
constexpr double kNoArea = 1e-10;

std::string Text(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.4g", value);
  return text;
}

std::string FaceName(int f) { return "face " + std::to_string(f); }

double Cross(const Vector2d& u, const Vector2d& v) {
  return u[0] * v[1] - u[1] * v[0];
}

// Twice the signed area of pattern triangle f.
double RestArea2(const Garment& g, int f) {
  const Vector2d a = g.rest.col(g.rest_faces(0, f));
  return Cross(g.rest.col(g.rest_faces(1, f)) - a,
               g.rest.col(g.rest_faces(2, f)) - a);
}

void CheckSize(const Garment& g, const std::string& name) {
  const double size =
      (g.placed.rowwise().maxCoeff() - g.placed.rowwise().minCoeff())
          .maxCoeff();
  if (size >= kSmallest && size <= kLargest) return;
  std::string hint;
  if (size > 20.0 && size < 300.0) hint = " (centimetres? multiply by 0.01)";
  if (size >= 300.0 && size < 3000.0)
    hint = " (millimetres? multiply by 0.001)";
  throw InputError(name + ": garment is " + Text(size) +
                   " m across, expected " + Text(kSmallest) + " to " +
                   Text(kLargest) + " m" + hint);
}

void CheckPattern(const Garment& g, const std::string& name) {
  if (g.rest_faces.cols() != g.faces.cols())
    throw InputError(name + ": " + std::to_string(g.rest_faces.cols()) +
                     " pattern triangles, expected one for each of " +
                     std::to_string(g.faces.cols()) + " faces");
  for (int i = 0; i < g.rest.cols(); ++i)
    if (!g.rest.col(i).allFinite())
      throw InputError(name + ": pattern point " + std::to_string(i) +
                       " is not finite, expected numbers");
  int inverted = 0;
  for (int f = 0; f < g.num_faces(); ++f) {
    for (int c = 0; c < 3; ++c)
      if (g.rest_faces(c, f) < 0 || g.rest_faces(c, f) >= g.rest.cols())
        throw InputError(
            name + ": " + FaceName(f) + " refers to pattern point " +
            std::to_string(g.rest_faces(c, f)) + ", expected 0 to " +
            std::to_string(g.rest.cols() - 1));
    inverted += RestArea2(g, f) < 0.0 ? 1 : 0;
  }
  for (int f = 0; f < g.num_faces(); ++f) {
    double longest = 0.0;
    for (int c = 0; c < 3; ++c)
      longest = std::max(longest,
                         (g.rest.col(g.rest_faces(c, f)) -
                          g.rest.col(g.rest_faces((c + 1) % 3, f)))
                             .squaredNorm());
    const double area2 = RestArea2(g, f);
    if (!(std::abs(area2) > kNoArea * longest))
      throw InputError(name + ": " + FaceName(f) +
                       " has no area in the pattern");
    if (area2 < 0.0)
      throw InputError(
          name + ": " + FaceName(f) + " is inverted in the pattern (" +
          std::to_string(inverted) + " of " + std::to_string(g.num_faces()) +
          " are), expected counter-clockwise triangles");
  }
}

void CheckScale(const Garment& g, const std::string& name) {
  std::vector<double> ratio;
  ratio.reserve(3 * g.num_faces());
  for (int f = 0; f < g.num_faces(); ++f) {
    for (int c = 0; c < 3; ++c) {
      const int d = (c + 1) % 3;
      const double placed =
          (g.placed.col(g.faces(c, f)) - g.placed.col(g.faces(d, f))).norm();
      const double rest =
          (g.rest.col(g.rest_faces(c, f)) - g.rest.col(g.rest_faces(d, f)))
              .norm();
      ratio.push_back(placed / rest);
    }
  }
  const auto middle = ratio.begin() + static_cast<long>(ratio.size() / 2);
  std::nth_element(ratio.begin(), middle, ratio.end());
  if (*middle > 1.0 / kScale && *middle < kScale) return;
  throw InputError(name + ": placed edges are typically " + Text(*middle) +
                   " times as long as in the pattern, expected " +
                   Text(1.0 / kScale) + " to " + Text(kScale) +
                   " (vt are metres of cloth, not texture coordinates)");
}

// The pattern axes of a face in space: y is the projection of the vertical
// (of +z if the face is horizontal), x to its right seen from outside.
void PatternAxes(const Vector3d& normal, Vector3d* x, Vector3d* y) {
  for (const Vector3d& up : {Vector3d(0, 1, 0), Vector3d(0, 0, 1)}) {
    *y = up - normal.dot(up) * normal;
    if (y->norm() > 1e-3) break;
  }
  y->normalize();
  *x = y->cross(normal);
}

}  // namespace

Garment ReadGarment(const std::string& path) {
  return ParseGarment(ReadFileBytes(path), path);
}

Garment ParseGarment(std::string_view obj, const std::string& path) {
  const ObjMesh mesh = ParseObj(obj, path);
  const std::string name = path + " (counting from 0)";
  ValidateMesh(mesh.vertices, mesh.faces, name);
  Garment g = GarmentFromRestMesh(mesh.vertices, mesh.faces);
  if (mesh.texture_faces.cols() > 0) {
    g.rest = mesh.texture;
    g.rest_faces = mesh.texture_faces;
    g.rest_angles_from_placed = false;
  }
  ValidateGarment(g, name);
  return g;
}

void ValidateGarment(const Garment& garment, const std::string& name) {
  ValidateMesh(garment.placed, garment.faces, name);
  CheckSize(garment, name);
  CheckPattern(garment, name);
  CheckScale(garment, name);
}

VectorXd VertexAreas(const Garment& garment) {
  VectorXd areas = VectorXd::Zero(garment.num_vertices());
  for (int f = 0; f < garment.num_faces(); ++f)
    for (int c = 0; c < 3; ++c)
      areas[garment.faces(c, f)] += RestArea2(garment, f) / 6.0;
  return areas;
}

Garment GarmentFromRestMesh(const Points& vertices, const Faces& faces) {
  Garment g;
  g.placed = vertices;
  g.faces = faces;
  g.rest_angles_from_placed = true;
  g.rest.resize(2, 3 * faces.cols());
  g.rest_faces.resize(3, faces.cols());
  const Points normals = FaceNormals(vertices, faces);
  for (int f = 0; f < g.num_faces(); ++f) {
    Vector3d x, y;
    PatternAxes(normals.col(f), &x, &y);
    const Vector3d origin = vertices.col(faces(0, f));
    for (int c = 0; c < 3; ++c) {
      const Vector3d p = vertices.col(faces(c, f)) - origin;
      g.rest.col(3 * f + c) << x.dot(p), y.dot(p);
      g.rest_faces(c, f) = 3 * f + c;
    }
  }
  return g;
}

}  // namespace invsim
