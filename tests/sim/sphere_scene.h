// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_TESTS_SIM_SPHERE_SCENE_H_
#define INVSIM_TESTS_SIM_SPHERE_SCENE_H_

// Small scenes: a square of cloth above a sphere or a plate.

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "invsim/cloth/effect_registry.h"
#include "invsim/cloth/effects/bending.h"
#include "invsim/cloth/effects/gravity.h"
#include "invsim/cloth/effects/inertia.h"
#include "invsim/cloth/effects/membrane.h"
#include "invsim/cloth/garment.h"
#include "invsim/cloth/mass.h"
#include "invsim/geometry/mesh.h"
#include "invsim/sim/simulator.h"

namespace invsim {

inline TriangleMesh Icosphere(double radius, int levels) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  TriangleMesh m;
  m.vertices.resize(3, 12);
  m.vertices << -1, 1, -1, 1, 0, 0, 0, 0, g, g, -g, -g,  //
      g, g, -g, -g, -1, 1, -1, 1, 0, 0, 0, 0,            //
      0, 0, 0, 0, g, g, -g, -g, -1, 1, -1, 1;
  m.faces.resize(3, 20);
  m.faces << 0, 0, 0, 0, 0, 1, 5, 11, 10, 7, 3, 3, 3, 3, 3, 4, 2, 6, 8, 9,  //
      11, 5, 1, 7, 10, 5, 11, 10, 7, 1, 9, 4, 2, 6, 8, 9, 4, 2, 6, 8,       //
      5, 1, 7, 10, 11, 9, 4, 2, 6, 8, 4, 2, 6, 8, 9, 5, 11, 10, 7, 1;
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middle;
    std::vector<Vector3d> points;
    for (int i = 0; i < m.vertices.cols(); ++i)
      points.push_back(m.vertices.col(i));
    const auto split = [&](int a, int b) {
      const auto key = std::minmax(a, b);
      const auto found = middle.find(key);
      if (found != middle.end()) return found->second;
      points.push_back(0.5 * (points[a] + points[b]));
      return middle[key] = static_cast<int>(points.size()) - 1;
    };
    Faces faces(3, 4 * m.faces.cols());
    for (int f = 0; f < m.faces.cols(); ++f) {
      const int a = m.faces(0, f), b = m.faces(1, f), c = m.faces(2, f);
      const int x = split(a, b), y = split(b, c), z = split(c, a);
      faces.col(4 * f) << a, x, z;
      faces.col(4 * f + 1) << x, b, y;
      faces.col(4 * f + 2) << z, y, c;
      faces.col(4 * f + 3) << x, y, z;
    }
    m.faces = faces;
    m.vertices.resize(3, points.size());
    for (size_t i = 0; i < points.size(); ++i) m.vertices.col(i) = points[i];
  }
  m.vertices.colwise().normalize();
  m.vertices *= radius;
  return m;
}

// A closed slab whose top is the square |x|, |z| <= half at y = 0.
inline TriangleMesh Slab(double half, double depth) {
  TriangleMesh m;
  m.vertices.resize(3, 8);
  m.vertices << -half, half, half, -half, -half, half, half, -half,  //
      0, 0, 0, 0, -depth, -depth, -depth, -depth,                    //
      -half, -half, half, half, -half, -half, half, half;
  m.faces.resize(3, 12);
  m.faces << 0, 0, 4, 4, 0, 0, 1, 1, 2, 2, 3, 3,  //
      2, 3, 5, 6, 1, 5, 2, 6, 3, 7, 0, 4,         //
      1, 2, 6, 7, 5, 4, 6, 5, 7, 6, 4, 7;
  return m;
}

// n x n cells in the plane y = height, seen from above.
inline Garment Square(int n, double side, double height) {
  Points vertices(3, (n + 1) * (n + 1));
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      vertices.col(i * (n + 1) + j) =
          Vector3d(side * (static_cast<double>(j) / n - 0.5),
                   height,
                   side * (static_cast<double>(i) / n - 0.5));
  Faces faces(3, 2 * n * n);
  int f = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const int a = i * (n + 1) + j, b = a + 1, c = a + n + 1, d = c + 1;
      if ((i + j) % 2 == 0) {
        faces.col(f++) << a, c, b;
        faces.col(f++) << b, c, d;
      } else {
        faces.col(f++) << a, d, b;
        faces.col(f++) << a, c, d;
      }
    }
  }
  return GarmentFromRestMesh(vertices, faces);
}

// Two pieces of cloth as one garment.
inline Garment Together(const Garment& a, const Garment& b) {
  const int n = a.num_vertices();
  Points vertices(3, n + b.num_vertices());
  vertices << a.placed, b.placed;
  Faces faces(3, a.num_faces() + b.num_faces());
  faces << a.faces, (b.faces.array() + n).matrix();
  return GarmentFromRestMesh(vertices, faces);
}

// Two slabs with a gap of 8 mm from y = 0 up.
inline TriangleMesh TwoSlabs() {
  const TriangleMesh slab = Slab(0.3, 0.1);
  TriangleMesh both;
  both.vertices.resize(3, 16);
  both.vertices << slab.vertices,
      slab.vertices.colwise() + Vector3d(0, 0.108, 0);
  both.faces.resize(3, 24);
  both.faces << slab.faces, (slab.faces.array() + 8).matrix();
  return both;
}

inline SimulatorSetup ClothSetup(const Garment& garment,
                                 const TriangleMesh& body) {
  Material material;
  material.name = "test";
  material.density = 0.2;
  material.stretch = IsotropicStretch{200, 0.3};
  material.bending = IsotropicBending{1e-5};
  SimulatorSetup setup;
  setup.faces = garment.faces;
  setup.cloth = garment.placed;
  setup.mass = VertexMasses(garment, material);
  setup.effects.push_back(std::make_unique<Inertia>());
  setup.effects.push_back(
      std::make_unique<Gravity>(setup.mass, GravityOptions{}));
  setup.effects.push_back(
      std::make_unique<Membrane>(garment, material.stretch));
  setup.effects.push_back(std::make_unique<Bending>(garment, material.bending));
  setup.body = body.vertices;
  setup.body_faces = body.faces;
  return setup;
}

inline ClothState AtRest(const Garment& garment) {
  return {garment.placed, Points::Zero(3, garment.num_vertices())};
}

}  // namespace invsim

#endif  // INVSIM_TESTS_SIM_SPHERE_SCENE_H_
