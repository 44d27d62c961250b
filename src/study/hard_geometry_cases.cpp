// SPDX-License-Identifier: Apache-2.0

// Hard scenes: meshes that are badly made, tiny, large or far away.

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "hard_cases.h"
#include "invsim/study/cube_toy.h"

namespace invsim {
namespace {

// A line of the grid so many times nearer to its neighbour than others.
HardScene Slivers(double aspect) {
  const double cell = 0.03;
  std::vector<double> even, uneven;
  for (int i = -5; i <= 5; ++i) even.push_back(cell * i);
  uneven = even;
  uneven.push_back(cell + cell / aspect);
  std::sort(uneven.begin(), uneven.end());
  return SceneOf(Shifted(GridMesh(even, uneven), Vector3d(0, 0.123, 0)),
                 BallMesh(0.12));
}

HardScene OneTriangle() {
  TriangleMesh cloth;
  cloth.vertices.resize(3, 3);
  cloth.vertices << 0.03, -0.03, -0.03,  //
      0.13, 0.13, 0.13,                  //
      0.01, 0.04, -0.04;
  cloth.faces = Vector3d(0, 2, 1).cast<int>();
  return SceneOf(cloth, BallMesh(0.12));
}

HardScene ClosedTube() {
  return SceneOf(Shifted(RingMesh(0.07, 0.025, 18, 8), Vector3d(0, 0.13, 0)),
                 BallMesh(0.12));
}

HardScene TwoPieces() {
  const TriangleMesh piece = SheetMesh(6, 0.15);
  return SceneOf(Joined(Shifted(piece, Vector3d(-0.09, 0.123, 0)),
                        Shifted(piece, Vector3d(0.09, 0.123, 0))),
                 BallMesh(0.12));
}

HardScene ManyVertices() {
  HardScene scene = SheetOverBall(223);  // 50,176 vertices
  scene.frames = 2;
  scene.frames_per_second = 120;
  scene.options.step.substeps = 1;
  // A step takes seconds: one way to move the ball, aslant, and two sizes.
  scene.directions = {
      Vector3d(0.6, 0.8, 0).replicate(1, scene.body.vertices.cols())};
  scene.difference_steps = {1e-6, 1e-7};
  return scene;
}

HardScene FarAway() {
  const Vector3d there(1e4, 0, -1e4);
  HardScene scene = SheetOverBall();
  scene.garment.placed.colwise() += there;
  scene.body = Shifted(scene.body, there);
  // Positions hold 2e-12 m there, and differences at best the root of it.
  scene.limits.derivative = 1e-3;
  return scene;
}

HardScene GarmentInMillimetres() {
  const BodyModel cube = CubeBody();
  Garment sheet = SheetAbove(cube.Vertices({}), 8, 0.003);
  sheet.placed *= 1000;
  sheet.rest *= 1000;
  CheckGarmentFits(sheet, cube, ShapeVector::Zero(), "sheet");
  HardScene scene = SheetOverBall();
  scene.garment = sheet;
  return scene;
}

}  // namespace

void AddGeometryCases(std::vector<HardCase>* cases) {
  const auto add = [&](const char* name,
                       const char* shows,
                       std::function<HardScene()> make) -> HardCase& {
    return cases->emplace_back(
        HardCase{std::string("geometry/") + name, shows, std::move(make)});
  };
  add("slivers_100", "cloth triangles of aspect 100", [] {
    return Slivers(100);
  });
  add("slivers_1000", "cloth triangles of aspect 1,000", [] {
    HardScene scene = Slivers(1000);
    scene.frames = 10;
    // Rounding does not let steps be solved as closely as differences need.
    scene.limits.columns = 0;
    return scene;
  });
  HardCase& slivers =
      add("slivers_10000", "cloth triangles of aspect 10,000", [] {
        HardScene scene = Slivers(10000);
        scene.frames = 3;  // most steps are halved three times
        return scene;
      });
  slivers.border =
      "bending across a sliver is ten orders stiffer than elsewhere: rounding "
      "alone is above the contact tolerance";
  slivers.ceiling.missed = std::numeric_limits<int>::max();
  add("one_triangle", "cloth of a single face", OneTriangle);
  add("closed_tube", "cloth without a boundary", ClosedTube);
  add("two_pieces", "cloth in two parts that do not touch", TwoPieces);
  add("50k_vertices", "a sheet of 50,176 vertices", ManyVertices);
  add("10_km_away", "all of it 14 km from the origin", FarAway);
  add("millimetres", "a garment in millimetres", GarmentInMillimetres).refused =
      true;
}

}  // namespace invsim
