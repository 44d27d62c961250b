// SPDX-License-Identifier: Apache-2.0

// Hard scenes: contact at its corners.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "hard_cases.h"

namespace invsim {
namespace {

Matrix3d Turn(double angle, const Vector3d& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

HardScene StartInside() {
  HardScene scene = SheetOverBall();
  scene.garment.placed.row(1).array() -= 0.033;
  scene.grace = 20;
  return scene;
}

HardScene AllInContact() {
  HardScene scene = SceneOf(Shifted(SheetMesh(10, 0.2), Vector3d(0, 0.152, 0)),
                            BoxMesh(Vector3d::Constant(0.15)));
  scene.limits.contacts = static_cast<int>(scene.garment.num_vertices());
  return scene;
}

// A sheet whose middle vertex is exactly above an edge or a corner.
HardScene OverTurnedCube(const Matrix3d& turn) {
  const TriangleMesh cube = Turned(BoxMesh(Vector3d::Constant(0.1)), turn);
  const double top = cube.vertices.row(1).maxCoeff();
  return SceneOf(Shifted(SheetMesh(10, 0.35), Vector3d(0, top + 0.003, 0)),
                 cube);
}

HardScene CubeEdge() {
  return OverTurnedCube(Turn(EIGEN_PI / 4, Vector3d::UnitZ()));
}

HardScene CubeCorner() {
  const Vector3d up = Vector3d::UnitY();
  return OverTurnedCube(Eigen::Quaterniond::FromTwoVectors(Vector3d::Ones(), up)
                            .toRotationMatrix());
}

// An octahedron's tip.
HardScene BodyVertex() {
  return SceneOf(Shifted(SheetMesh(10, 0.35), Vector3d(0, 0.123, 0)),
                 BallMesh(0.12, 0));
}

// A blade of 2 mm whose faces are 20 m long, below a line of vertices.
HardScene SliverFace() {
  return SceneOf(Shifted(SheetMesh(10, 0.3), Vector3d(0.0003, 0.053, 0)),
                 BoxMesh(Vector3d(0.001, 0.05, 10)));
}

HardScene SelfIntersecting() {
  const TriangleMesh ball = BallMesh(0.12);
  return SceneOf(Shifted(SheetMesh(12, 0.35), Vector3d(0, 0.125, 0)),
                 Joined(Shifted(ball, Vector3d(-0.08, 0, 0)),
                        Shifted(ball, Vector3d(0.08, 0.01, 0.01))));
}

// 30 m/s onto a plate of 4 mm, half a metre a step.
HardScene Tunnelling() {
  HardScene scene = SceneOf(Shifted(SheetMesh(8, 0.2), Vector3d(0, 1.1, 0)),
                            BoxMesh(Vector3d(0.4, 0.002, 0.4)));
  scene.options.step.substeps = 1;
  scene.start = {
      scene.garment.placed,
      Vector3d(0, -30, 0).replicate(1, scene.garment.num_vertices())};
  scene.frames = 10;
  scene.misplaced = [](const Points& cloth, const Points&) {
    return static_cast<int>((cloth.row(1).array() < 0).count());
  };
  return scene;
}

// Two sheets, one on the other, over the ball: cloth on cloth on body.
HardScene Layers() {
  HardScene scene = SheetOverBall(8, 0.25);
  const TriangleMesh sheet = SheetMesh(8, 0.25);
  scene.garment =
      AsGarment(Joined(Shifted(sheet, Vector3d(0, 0.123, 0)),
                       Shifted(sheet, Vector3d(0.01, 0.126, 0.007))));
  scene.options.effects.push_back("self_contact");
  return scene;
}

// The ball is dragged to and fro by 5 cm and turned.
HardScene Friction(double mu) {
  HardScene scene = SheetOverBall();
  scene.options.contact.friction = mu;
  scene.frames = 60;
  const TriangleMesh ball = scene.body;
  scene.body_at = [ball](int frame) {
    const double t = frame / 60.0;
    const double s = std::sin(2 * EIGEN_PI * t);
    return Shifted(Turned(ball, Turn(0.5 * s * s, Vector3d(0, 1, 1))),
                   Vector3d(0.05 * s * s, 0, 0))
        .vertices;
  };
  return scene;
}

HardScene OnSlope(double angle, double mu) {
  const Matrix3d turn = Turn(angle, Vector3d::UnitZ());
  HardScene scene =
      SceneOf(Turned(Shifted(SheetMesh(6, 0.2), Vector3d(0, 0.052, 0)), turn),
              Turned(BoxMesh(Vector3d(0.5, 0.05, 0.5)), turn));
  scene.options.contact.friction = mu;
  return scene;
}

// A table shaken sideways with 1.4 times the acceleration that friction can
// hand on: the sheet sticks and slides twice a period. (From sqrt(1 + pi^2 / 4)
// = 1.86 times on it would only slide: it then moves at a constant acceleration
// either way, and the table is beyond that wherever their speeds meet.)
HardScene StickSlip() {
  HardScene scene = OnSlope(0, 0.3);
  const Points table = scene.body.vertices;
  scene.frames = 120;
  scene.body_at = [table](int frame) {
    constexpr double kOmega = 4 * EIGEN_PI, kGravity = 9.8;
    const double a = 1.4 * 0.3 * kGravity / (kOmega * kOmega);
    const double t = frame / 60.0;
    return Points(table.colwise() +
                  Vector3d(a * (std::cos(kOmega * t) - 1), 0, 0));
  };
  scene.check = [](const StepStats& stats) {
    const int closed = stats.stick + stats.slide;
    return std::min(stats.stick, stats.slide) > closed / 10
               ? ""
               : "nine of ten contacts only stick, or only slide";
  };
  return scene;
}

HardScene Resting() {
  HardScene scene = OnSlope(0.2, 0.5);
  scene.frames = 510;  // four steps each
  scene.grace = 10;
  scene.limits.creep = 1e-6;
  return scene;
}

}  // namespace

void AddContactCases(std::vector<HardCase>* cases) {
  const auto add = [&](const char* name,
                       const char* shows,
                       std::function<HardScene()> make) {
    cases->push_back({std::string("contact/") + name, shows, std::move(make)});
  };
  add("start_inside", "cloth that starts 3 cm inside the body", StartInside);
  add("squeezed", "cloth between boards that leave it no room", [] {
    return SheetBetweenBoards(0.002);
  });
  add("armpit", "cloth in a V that closes on it", [] { return SheetInV(20); });
  add("all_in_contact", "every vertex in contact", AllInContact);
  add("cube_edge", "a vertex exactly above an edge", CubeEdge);
  add("cube_corner", "a vertex exactly above a corner", CubeCorner);
  add("body_vertex",
      "a vertex exactly above the tip of an octahedron",
      BodyVertex);
  add("sliver_face", "a blade of 2 mm with faces of aspect 10,000", SliverFace);
  add("self_intersecting", "a body that crosses itself", SelfIntersecting);
  add("layers", "two sheets on each other and the body", Layers);
  add("tunnelling", "30 m/s onto a plate of 4 mm", Tunnelling);
  add("mu_0", "no friction", [] { return Friction(0); });
  add("mu_0.3", "friction 0.3", [] { return Friction(0.3); });
  add("mu_1", "friction 1", [] { return Friction(1); });
  add("mu_5", "friction 5", [] { return Friction(5); });
  add("stick_slip", "sticking and sliding in turn", StickSlip);
  add("zero_slip", "a slope at exactly the angle of friction", [] {
    return OnSlope(std::atan(0.3), 0.3);
  });
  add("resting", "2,000 steps at rest on a slope without creep", Resting);
}

}  // namespace invsim
