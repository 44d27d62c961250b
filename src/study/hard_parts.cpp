// SPDX-License-Identifier: Apache-2.0

// What hard scenes are made of.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "hard_cases.h"
#include "invsim/base/config.h"
#include "invsim/base/options.h"
#include "invsim/geometry/subdivision.h"

namespace invsim {

TriangleMesh BallMesh(double radius, int levels) {
  TriangleMesh mesh;
  mesh.vertices.resize(3, 6);
  mesh.vertices << 1, -1, 0, 0, 0, 0,  //
      0, 0, 1, -1, 0, 0,               //
      0, 0, 0, 0, 1, -1;
  mesh.faces.resize(3, 8);
  mesh.faces << 0, 2, 1, 3, 2, 1, 3, 0,  //
      2, 1, 3, 0, 0, 2, 1, 3,            //
      4, 4, 4, 4, 5, 5, 5, 5;
  for (int level = 0; level < levels; ++level) {
    mesh = SubdivideMidpoint(mesh).mesh;
    mesh.vertices.colwise().normalize();
  }
  mesh.vertices *= radius;
  return mesh;
}

TriangleMesh BoxMesh(const Vector3d& half) {
  TriangleMesh mesh;
  mesh.vertices.resize(3, 8);
  for (int k = 0; k < 8; ++k)
    mesh.vertices.col(k) = half.cwiseProduct(
        Vector3d(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1));
  mesh.faces.resize(3, 12);
  mesh.faces << 0, 0, 4, 4, 0, 0, 2, 2, 0, 0, 1, 1,  //
      3, 2, 5, 7, 1, 5, 7, 6, 6, 4, 3, 7,            //
      1, 3, 7, 6, 5, 4, 3, 7, 2, 6, 7, 5;
  return mesh;
}

TriangleMesh Joined(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh mesh;
  mesh.vertices.resize(3, a.vertices.cols() + b.vertices.cols());
  mesh.vertices << a.vertices, b.vertices;
  mesh.faces.resize(3, a.faces.cols() + b.faces.cols());
  mesh.faces << a.faces,
      (b.faces.array() + static_cast<int>(a.vertices.cols())).matrix();
  return mesh;
}

TriangleMesh Shifted(TriangleMesh mesh, const Vector3d& by) {
  mesh.vertices.colwise() += by;
  return mesh;
}

TriangleMesh Turned(TriangleMesh mesh, const Matrix3d& rotation) {
  mesh.vertices = rotation * mesh.vertices;
  return mesh;
}

TriangleMesh GridMesh(const std::vector<double>& x,
                      const std::vector<double>& z) {
  const int nx = static_cast<int>(x.size()), nz = static_cast<int>(z.size());
  TriangleMesh mesh;
  mesh.vertices.resize(3, nx * nz);
  for (int j = 0; j < nz; ++j)
    for (int i = 0; i < nx; ++i)
      mesh.vertices.col(j * nx + i) = Vector3d(x[i], 0, z[j]);
  mesh.faces.resize(3, 2 * (nx - 1) * (nz - 1));
  int f = 0;
  for (int j = 0; j + 1 < nz; ++j)
    for (int i = 0; i + 1 < nx; ++i) {
      const int a = j * nx + i, b = a + 1, c = a + nx, d = c + 1;
      const bool even = (i + j) % 2 == 0;
      mesh.faces.col(f++) << a, (even ? c : d), b;
      mesh.faces.col(f++) << (even ? b : a), c, d;
    }
  return mesh;
}

TriangleMesh SheetMesh(int cells, double side) {
  std::vector<double> lines(cells + 1);
  for (int i = 0; i <= cells; ++i)
    lines[i] = side * (static_cast<double>(i) / cells - 0.5);
  return GridMesh(lines, lines);
}

TriangleMesh Upright(TriangleMesh sheet) {
  return Turned(
      std::move(sheet),
      Eigen::AngleAxisd(-EIGEN_PI / 2, Vector3d::UnitZ()).toRotationMatrix());
}

TriangleMesh RingMesh(double radius, double tube, int around, int across) {
  TriangleMesh mesh;
  mesh.vertices.resize(3, around * across);
  mesh.faces.resize(3, 2 * around * across);
  const auto at = [&](int i, int j) {
    return (i % around) * across + j % across;
  };
  int f = 0;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double a = 2 * EIGEN_PI * i / around, b = 2 * EIGEN_PI * j / across;
      const double r = radius + tube * std::cos(b);
      mesh.vertices.col(at(i, j)) =
          Vector3d(r * std::cos(a), tube * std::sin(b), r * std::sin(a));
      mesh.faces.col(f++) << at(i, j), at(i, j + 1), at(i + 1, j);
      mesh.faces.col(f++) << at(i + 1, j), at(i, j + 1), at(i + 1, j + 1);
    }
  return mesh;
}

Garment AsGarment(const TriangleMesh& mesh) {
  return GarmentFromRestMesh(mesh.vertices, mesh.faces);
}

HardScene SceneOf(const TriangleMesh& cloth, TriangleMesh body) {
  HardScene scene;
  scene.limits.contacts = body.faces.cols() > 0 ? 1 : 0;
  scene.body = std::move(body);
  scene.garment = AsGarment(cloth);
  scene.material = {
      "cloth", 0.2, IsotropicStretch{200, 0.3}, IsotropicBending{1e-5}};
  return scene;
}

HardScene SheetOverBall(int cells, double side) {
  constexpr double kRadius = 0.12;
  return SceneOf(
      Shifted(SheetMesh(cells, side), Vector3d(0, kRadius + 0.003, 0)),
      BallMesh(kRadius));
}

HardScene SheetBetweenBoards(double gap) {
  const Vector3d half(0.05, 0.3, 0.15);
  const TriangleMesh left = Shifted(BoxMesh(half), Vector3d(-0.07, 0, 0));
  const TriangleMesh right = Shifted(BoxMesh(half), Vector3d(0.07, 0, 0));
  HardScene scene = SceneOf(Upright(SheetMesh(8, 0.2)), Joined(left, right));
  scene.frames = 60;
  scene.body_at = [=](int frame) {
    const double closed = std::min(frame, 6) / 6.0;
    const double slid = std::clamp((frame - 6) / 40.0, 0.0, 1.0);
    const Vector3d in((0.02 - 0.5 * gap) * closed, 0, 0);
    const Vector3d along(0, 0.05 * slid, 0);
    return Joined(Shifted(left, in), Shifted(right, along - in)).vertices;
  };
  return scene;
}

HardScene SheetInV(double degrees) {
  constexpr double kOpen = 80;
  // Inner faces meet in one line, so that the body never overlaps itself.
  const Vector3d half(0.02, 0.2, 0.2);
  const TriangleMesh left = Shifted(BoxMesh(half), Vector3d(-0.02, 0.2, 0));
  const TriangleMesh right = Shifted(BoxMesh(half), Vector3d(0.02, 0.2, 0));
  HardScene scene =
      SceneOf(Shifted(Upright(SheetMesh(8, 0.2)), Vector3d(0, 0.18, 0)), {});
  const auto v = [left, right](double opening) {
    const auto leaning = [&](const TriangleMesh& board, double by) {
      return Turned(
          board, Eigen::AngleAxisd(by, Vector3d::UnitZ()).toRotationMatrix());
    };
    const double angle = 0.5 * opening * EIGEN_PI / 180;
    return Joined(leaning(left, angle), leaning(right, -angle));
  };
  scene.body = v(kOpen);
  scene.limits.contacts = 1;
  scene.frames = 60;
  scene.body_at = [v, degrees](int frame) {
    const double closed = std::min(frame, 40) / 40.0;
    return v(kOpen + closed * (degrees - kOpen)).vertices;
  };
  return scene;
}

void SetOption(HardScene* scene,
               const std::string& key,
               const std::string& value) {
  OptionTable table;
  Describe(&table, &scene->options);
  Config config;
  config.Set(key, value, "hard scene");
  table.Read(config);
}

}  // namespace invsim
