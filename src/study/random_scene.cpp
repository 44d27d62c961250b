// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/random_scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <utility>
#include <vector>

#include "invsim/geometry/self_intersection.h"
#include "scene_draw.h"

namespace invsim {
namespace {

// See RandomScene.
constexpr double kRounding = 1e9;

// A person takes as long as ten scenes of some tens of vertices.
constexpr std::uint64_t kPersonEvery = 32;

// Draws a scene of simple bodies.
class Draw : SceneDraw {
 public:
  explicit Draw(std::uint64_t seed) : SceneDraw(seed) {}

  RandomScene Scene();

 private:
  std::vector<double> Lines(int cells, double side, double sliver);
  TriangleMesh Sheet();
  TriangleMesh Cloth();
  void DrawTime();
  TriangleMesh Capsule();
  TriangleMesh Compact();
  void PutBetweenBoards(const TriangleMesh& cloth);
  void PutAbove(TriangleMesh cloth);
  void MoveBody();
  void GiveGrace(double depth);
  void DrawStart();
  void PutFarAway();

  double depth_ = 0;  // m, of the body: how far in the cloth can get
};

// Lines of a grid; the one added is `sliver` of a cell from its neighbour.
std::vector<double> Draw::Lines(int cells, double side, double sliver) {
  std::vector<double> lines;
  for (int i = 0; i <= cells; ++i)
    lines.push_back(side * (static_cast<double>(i) / cells - 0.5));
  if (sliver > 0) {
    lines.push_back(lines[cells / 2] + sliver * side / cells);
    std::sort(lines.begin(), lines.end());
  }
  return lines;
}

TriangleMesh Draw::Sheet() {
  const int nx = 1 + random_.Index(6), nz = 1 + random_.Index(6);
  const double x = Log(0.03, 0.4), z = Log(0.03, 0.4);
  Say("sheet of ", nx, " x ", nz, " cells, ", x, " x ", z, " m");
  double sliver = 0;
  if (Chance(0.15)) {
    sliver = Log(1e-4, 0.1);
    Say("slivers 1:", 1 / sliver);
  }
  TriangleMesh mesh = GridMesh(Lines(nx, x, 0), Lines(nz, z, sliver));
  if (sliver > 0 || !Chance(0.5)) return mesh;
  for (Eigen::Index i = 0; i < mesh.vertices.cols(); ++i)
    mesh.vertices.col(i) += Vector3d(random_.Uniform(-0.3, 0.3) * x / nx,
                                     0,
                                     random_.Uniform(-0.3, 0.3) * z / nz);
  Say("uneven");
  return mesh;
}

TriangleMesh Draw::Cloth() {
  TriangleMesh mesh;
  const double kind = random_.Uniform();
  if (kind < 0.05) {
    const double side = Log(0.03, 0.2);
    Say("a triangle of ", side, " m");
    mesh = GridMesh({0, side}, {0, side});
    mesh.vertices.conservativeResize(3, 3);
    mesh.faces = Vector3d(0, 2, 1).cast<int>();
  } else if (kind < 0.15) {
    const double radius = Log(0.04, 0.15), tube = radius * Log(0.1, 0.5);
    Say("a ring of ", radius, " and ", tube, " m");
    mesh = RingMesh(radius, tube, 9, 5);
  } else if (kind < 0.3) {
    mesh = Sheet();
    const double gap = Log(0.002, 0.02);
    Say("twice, ", gap, " m apart");
    mesh = Joined(mesh, Shifted(mesh, Vector3d(0.003, gap, 0.001)));
  } else {
    mesh = Sheet();
  }
  return mesh;
}

void Draw::DrawTime() {
  scene_.frames = 4 + random_.Index(7);
  scene_.frames_per_second = Log(10, 2000);
  scene_.options.step.substeps = 1 + random_.Index(4);
  Say("frames of 1/",
      scene_.frames_per_second,
      " s in ",
      scene_.options.step.substeps);
}

// Long in y.
TriangleMesh Draw::Capsule() {
  const double radius = Log(0.02, 0.08), half = Log(0.02, 0.15);
  TriangleMesh mesh = BallMesh(radius, 2);
  for (Eigen::Index i = 0; i < mesh.vertices.cols(); ++i)
    mesh.vertices(1, i) += mesh.vertices(1, i) >= 0 ? half : -half;
  return mesh;
}

// A body in one piece or in two that may cross.
TriangleMesh Draw::Compact() {
  const double size = Log(0.03, 0.15);
  switch (random_.Index(5)) {
    case 0:
      Say("a ball of ", size, " m");
      depth_ = size;
      return BallMesh(size, 2);
    case 1:
      Say("a cube of ", size, " m");
      depth_ = size;
      return Turned(BoxMesh(Vector3d::Constant(size)),
                    Chance(0.3) ? Matrix3d::Identity().eval() : Turn());
    case 2:
      Say("an octahedron of ", size, " m");
      depth_ = size;
      return BallMesh(size, 0);
    case 3:
      Say("a blade of ", size, " m");
      depth_ = 0.001;
      return Turned(BoxMesh(Vector3d(0.001, size, 10 * size)),
                    Chance(0.5) ? Matrix3d::Identity().eval() : Turn());
    default: {
      const double apart = random_.Uniform(0, 0.15);
      Say("two capsules, ", apart, " m apart");
      depth_ = 0.1;
      const TriangleMesh left = Turned(Capsule(), Turn());
      return Joined(Shifted(left, Vector3d(-apart, 0, 0)),
                    Shifted(Turned(Capsule(), Turn()), Vector3d(apart, 0, 0)));
    }
  }
}

// The cloth upright between boards that close on it to a gap, in parallel or
// in a V.
void Draw::PutBetweenBoards(const TriangleMesh& cloth) {
  constexpr double kHalf = 0.3;  // m, of a board's sides
  const TriangleMesh upright = Upright(cloth);
  const auto x = upright.vertices.row(0);
  const Vector3d middle = 0.5 * (upright.vertices.rowwise().maxCoeff() +
                                 upright.vertices.rowwise().minCoeff());
  scene_.garment = AsGarment(Shifted(upright, -middle));
  const bool v = Chance(0.4);
  const double gap = Log(0.001, 0.02), fps = scene_.frames_per_second;
  // At most as fast as a person claps.
  const double open = x.maxCoeff() - x.minCoeff() + 0.01;
  const double seconds = std::max(0.7 * scene_.frames / fps, open / 5);
  const TriangleMesh board =
      Shifted(BoxMesh(Vector3d(0.05, kHalf, kHalf)), Vector3d(0, kHalf, 0));
  scene_.body_at = [=](int frame) {
    const double s = std::min(1.0, frame / fps / seconds);
    const double half = 0.5 * ((1 - s) * open + s * gap) + 0.05;
    const auto placed = [&](double side) {
      const Eigen::AngleAxisd lean(v ? -side * 0.4 * (1 - s) : 0,
                                   Vector3d::UnitZ());
      return Shifted(Turned(board, lean.toRotationMatrix()),
                     Vector3d(side * half, -kHalf, 0));
    };
    return Joined(placed(-1), placed(1)).vertices;
  };
  scene_.body = {scene_.body_at(0), Joined(board, board).faces};
  Say("between ",
      v ? "a V" : "boards",
      " closing to ",
      gap,
      " m in ",
      seconds,
      " s");
}

// The cloth above the body, level or turned.
void Draw::PutAbove(TriangleMesh cloth) {
  if (Chance(0.3)) {
    cloth = Turned(std::move(cloth), Turn());
    Say("turned");
  }
  double top = 0;
  if (scene_.body.faces.cols() > 0)
    top = scene_.body.vertices.row(1).maxCoeff();
  top += scene_.options.contact.thickness + random_.Uniform(0, 0.005);
  const double bottom = cloth.vertices.row(1).minCoeff();
  scene_.garment =
      AsGarment(Shifted(std::move(cloth), Vector3d(0, top - bottom, 0)));
}

void Draw::MoveBody() {
  const double kind = random_.Uniform();
  const Points base = scene_.body.vertices;
  const double fps = scene_.frames_per_second;
  const Vector3d direction = Direction();
  if (kind < 0.3) {
    const double speed = Log(0.05, 5), length = Log(0.01, 0.3);
    Say("shaken by ", length, " m at ", speed, " m/s");
    scene_.body_at = [=](int frame) {
      const double s = std::sin(speed / length * frame / fps);
      return Points(base.colwise() + Vector3d(length * s * direction));
    };
  } else if (kind < 0.5) {
    const double rate = Log(0.1, 10);
    Say("turning at ", rate, " rad/s");
    scene_.body_at = [=](int frame) {
      const Eigen::AngleAxisd turn(rate * frame / fps, direction);
      return Points(turn.toRotationMatrix() * base);
    };
  } else if (kind < 0.65 && fps < 120) {
    const double jump = Log(0.005, 0.2);
    Say("jumping by ", jump, " m");
    GiveGrace(std::min(depth_, jump));
    scene_.body_at = [=](int frame) {
      return Points(base.colwise() +
                    Vector3d((frame < 2 ? 0 : jump) * direction));
    };
  }
}

// Time for the cloth to get out of the body from a depth.
void Draw::GiveGrace(double depth) {
  const double seconds =
      0.1 + 2 * depth / scene_.options.contact.recovery_speed;
  scene_.grace = 3 + static_cast<int>(seconds * scene_.frames_per_second);
  scene_.frames += scene_.grace;
}

void Draw::DrawStart() {
  Points& placed = scene_.garment.placed;
  const int n = static_cast<int>(placed.cols());
  if (Chance(0.15)) {
    const Vector3d v = Log(0.1, 10) * Direction();
    Say("thrown at ", v.norm(), " m/s");
    scene_.start = {placed, v.replicate(1, n)};
  } else if (Chance(0.1) && depth_ > 0.03 && scene_.frames_per_second < 120 &&
             scene_.grace == 0) {
    const double inside = Log(0.003, 0.03);
    Say("starting ", inside, " m inside");
    placed.row(1).array() -= inside + scene_.options.contact.thickness;
    GiveGrace(inside);
  }
  // A vertex that is held is not to be in the way of a body, or inside one.
  if (scene_.body_at || scene_.grace > 0 || !Chance(0.3)) return;
  scene_.pins.push_back({0, placed.col(0)});
  if (Chance(0.5)) scene_.pins.push_back({n - 1, placed.col(n - 1)});
  Say("pinned at ", scene_.pins.size());
}

void Draw::PutFarAway() {
  const Vector3d there(1e4, 0, -1e4);
  Say("14 km away");
  scene_.garment.placed.colwise() += there;
  if (scene_.start.x.cols() > 0) scene_.start.x.colwise() += there;
  for (Pin& pin : scene_.pins) pin.position += there;
  scene_.body = Shifted(std::move(scene_.body), there);
  if (scene_.body_at)
    scene_.body_at = [near = scene_.body_at, there](int frame) {
      return Points(near(frame).colwise() + there);
    };
  // Positions hold 2e-12 m there, and a stiff cloth makes more of it:
  // differences are good to no more.
  scene_.limits.derivative = 1e-2;
}

RandomScene Draw::Scene() {
  RandomScene drawn;
  drawn.derivative = Chance(0.2);
  const TriangleMesh cloth = Cloth();
  DrawMaterial();
  DrawEffects();
  DrawTime();
  const double kind = random_.Uniform();
  if (kind < 0.2) {
    PutBetweenBoards(cloth);
  } else if (kind < 0.25) {
    Say("no body");
    PutAbove(cloth);
    DrawStart();
  } else {
    scene_.body = Compact();
    PutAbove(cloth);
    MoveBody();
    DrawStart();
  }
  if (Chance(0.05)) PutFarAway();
  Finish(&drawn);
  return drawn;
}

// Whether the body does, in any frame: then no place is outside of all of it.
bool CrossesItself(const HardScene& scene) {
  for (int frame = 0; frame <= scene.frames; ++frame)
    if (!SelfIntersections(scene.body_at(frame), scene.body.faces).empty())
      return true;
  return false;
}

}  // namespace

HardOutcome RunRandomScene(const RandomScene& drawn) {
  try {
    return RunHardScene(drawn.scene, drawn.derivative);
  } catch (const std::exception& error) {
    HardOutcome outcome;
    outcome.broken.push_back({"throws", error.what()});
    return outcome;
  }
}

std::string KnownBorder(const RandomScene& drawn,
                        const HardOutcome& outcome,
                        const Breach& breach) {
  // Nothing excuses these.
  for (const char* limit : {"throws", "finite", "crossing", "derivative"})
    if (breach.limit == limit) return "";
  if (drawn.stiffness > kRounding)
    return "slivers so thin that rounding decides";
  if (breach.limit == "penetration" && outcome.step.stopped > 0)
    return "cloth stopped on its way through cloth is in the way of the body";
  if (breach.limit == "penetration" && IsPerson(drawn.seed) &&
      CrossesItself(drawn.scene))
    return "cloth caught where the body crosses itself is led out slowly";
  if (breach.limit != "energy") return "";
  if (outcome.step.stopped > 0)
    return "cloth stopped on its way through cloth strains its neighbours";
  if (outcome.step.missed > 0)
    return "steps above the contact tolerance do not balance";
  if (outcome.closed > 0)
    return "faces closed to lines or folded through, where bending has no "
           "angle";
  return "";
}

bool IsPerson(std::uint64_t seed) {
  return seed % kPersonEvery == kPersonEvery - 1;
}

RandomScene DrawScene(std::uint64_t seed) {
  RandomScene drawn = IsPerson(seed) ? DrawPerson(seed) : Draw(seed).Scene();
  drawn.seed = seed;
  return drawn;
}

}  // namespace invsim
