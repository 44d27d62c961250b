// SPDX-License-Identifier: Apache-2.0
#include "invsim/sim/simulator.h"

#include <gtest/gtest.h>

#include <limits>

#include "geometry/shapes.h"
#include "invsim/body/rotation.h"
#include "invsim/geometry/surface_index.h"
#include "invsim/sim/sensitivity.h"
#include "sphere_scene.h"

namespace invsim {
namespace {

constexpr double kFrameTime = 1 / 60.0;
constexpr double kGravity = 9.8;  // the default

TEST(Simulator, FreeFallIsExactForTheScheme) {
  const Garment garment = Square(6, 0.3, 1.0);
  SimulatorSetup setup = ClothSetup(garment, Icosphere(0.1, 1));
  setup.step.substeps = 4;
  Simulator simulator(std::move(setup));
  ClothState state = AtRest(garment);
  StepStats stats;
  const Points body = Icosphere(0.1, 1).vertices;
  for (int frame = 0; frame < 5; ++frame)
    ASSERT_TRUE(simulator.Advance(body, body, kFrameTime, &state, &stats));
  // Implicit Euler: v_n = -g n dt, x_n = x_0 - g dt^2 n (n + 1)/2.
  const int n = 20;
  const double dt = kFrameTime / 4;
  const double drop = kGravity * dt * dt * n * (n + 1) / 2;
  for (int i = 0; i < garment.num_vertices(); ++i) {
    EXPECT_LT((state.v.col(i) - Vector3d(0, -kGravity * n * dt, 0)).norm(),
              1e-9);
    EXPECT_LT(
        (garment.placed.col(i) - state.x.col(i) - Vector3d(0, drop, 0)).norm(),
        1e-9);
  }
}

// The plate tilted by `angle` about z, cloth lying on it.
struct Incline {
  Incline(double angle, double mu) {
    turn = Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix();
    plate = Slab(2, 0.5);
    plate.vertices = turn * plate.vertices;
    garment = Square(6, 0.3, 0.002);
    const Points flat = garment.placed;
    SimulatorSetup setup = ClothSetup(garment, plate);
    setup.contact.friction = mu;
    setup.step.friction.tolerance = 1e-8;
    simulator = std::make_unique<Simulator>(std::move(setup));
    state = {turn * flat, Points::Zero(3, flat.cols())};
  }
  bool Run(int frames) {
    for (int k = 0; k < frames; ++k)
      if (!simulator->Advance(
              plate.vertices, plate.vertices, kFrameTime, &state, &stats))
        return false;
    return stats.missed == 0;
  }
  Matrix3d turn;
  TriangleMesh plate;
  Garment garment;
  std::unique_ptr<Simulator> simulator;
  ClothState state;
  StepStats stats;
};

TEST(Simulator, ClothOnAnInclineSticksBelowTheFrictionAngle) {
  const double mu = 0.4;
  Incline scene(std::atan(mu) - 0.02, mu);
  const Points start = scene.state.x;
  ASSERT_TRUE(scene.Run(60));
  EXPECT_LT((scene.state.x - start).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(Simulator, ClothOnAnInclineSlidesAboveIt) {
  const double mu = 0.3, angle = 0.6;
  Incline scene(angle, mu);
  ASSERT_TRUE(scene.Run(30));
  const double expected =
      kGravity * (std::sin(angle) - mu * std::cos(angle)) * 30 * kFrameTime;
  const double speed = scene.state.v.rowwise().mean().norm();
  EXPECT_NEAR(speed, expected, 0.01 * expected);
}

TEST(Simulator, ContactForcesCarryTheWeightAtRest) {
  Incline scene(0, 0.3);
  ASSERT_TRUE(scene.Run(30));
  const double weight = kGravity * scene.simulator->mass().sum();
  const Vector3d force = scene.simulator->contact_force().rowwise().sum();
  EXPECT_NEAR(force.y(), weight, 1e-6 * weight);
  EXPECT_LT(std::hypot(force.x(), force.z()), 1e-6 * weight);
  // The body feels the reaction.
  const Vector3d reaction = scene.simulator->BodyForce().rowwise().sum();
  EXPECT_LT((force + reaction).norm(), 1e-9 * weight);
}

TEST(Simulator, RestsForTwoThousandStepsWithoutCreep) {
  Incline scene(0.2, 0.5);
  ASSERT_TRUE(scene.Run(10));
  const Points start = scene.state.x;
  ASSERT_TRUE(scene.Run(500));  // four sub-steps each
  EXPECT_LT((scene.state.x - start).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(Simulator, EnergyDoesNotGrowWithoutInput) {
  const Garment garment = Square(8, 0.3, 0.0);
  SimulatorSetup setup = ClothSetup(garment, Icosphere(0.1, 1));
  setup.body_faces.resize(3, 0);
  for (int corner : {0, 8})
    setup.pins.push_back({corner, garment.placed.col(corner)});
  Simulator simulator(std::move(setup));
  ClothState state = AtRest(garment);
  StepStats stats;
  double energy =
      simulator.PotentialEnergy(state) + simulator.KineticEnergy(state);
  const double scale = kGravity * simulator.mass().sum() * 0.3;
  for (int frame = 0; frame < 500; ++frame) {
    ASSERT_TRUE(simulator.Advance({}, {}, kFrameTime, &state, &stats));
    const double now =
        simulator.PotentialEnergy(state) + simulator.KineticEnergy(state);
    ASSERT_LT(now, energy + 1e-3 * scale) << "frame " << frame;
    energy = std::min(energy, now);
  }
  for (int corner : {0, 8})
    EXPECT_LT((state.x.col(corner) - garment.placed.col(corner)).norm(), 1e-9);
}

// Cloth that a ball drags along. With the rho that splitting begins with it
// takes 51 iterations a step; with rho fitted to the contacts' modes 39.
TEST(Simulator, DraggedClothIsSolvedWithRhoOfItsModes) {
  const double radius = 0.32, dt = 0.005;
  TriangleMesh ball = Icosphere(radius, 4);
  const Garment garment = Square(35, 0.6, radius + 0.004);
  SimulatorSetup setup = ClothSetup(garment, ball);
  setup.step.substeps = 1;
  Simulator simulator(std::move(setup));
  ClothState state = AtRest(garment);
  StepStats stats;
  const auto step = [&](double seconds, const Vector3d& move) {
    const Points next = ball.vertices.colwise() + move;
    ASSERT_TRUE(
        simulator.Advance(ball.vertices, next, seconds, &state, &stats));
    ball.vertices = next;
  };
  for (int k = 0; k < 80; ++k) step(2 * dt, Vector3d::Zero());
  for (int k = 0; k < 10; ++k) step(dt, dt * Vector3d(0.5, 0, 0.2));
  stats = {};
  for (int k = 0; k < 10; ++k) step(dt, dt * Vector3d(0.5, 0, 0.2));
  EXPECT_EQ(stats.missed, 0);
  EXPECT_EQ(stats.newton_iterations, 0);
  EXPECT_GT(stats.factorizations, 10);
  EXPECT_LE(stats.factorizations, 20);
  EXPECT_LT(stats.admm_iterations, 450);
}

TEST(Simulator, LeadsAStartInsideTheBodyOut) {
  const TriangleMesh ball = Icosphere(0.12, 3);
  const Garment garment = Square(10, 0.3, 0.1);  // 2 cm inside at the pole
  Simulator simulator(ClothSetup(garment, ball));
  ClothState state = AtRest(garment);
  EXPECT_GT(simulator.FindInside(ball.vertices, state), 0);
  StepStats stats;
  for (int frame = 0; frame < 30; ++frame)
    ASSERT_TRUE(simulator.Advance(
        ball.vertices, ball.vertices, kFrameTime, &state, &stats));
  EXPECT_EQ(stats.missed, 0);
  EXPECT_EQ(simulator.FindInside(ball.vertices, state), 0);
}

TEST(Simulator, RepeatsExactly) {
  const TriangleMesh ball = Icosphere(0.12, 3);
  const Garment garment = Square(10, 0.3, 0.13);
  Points end[2];
  for (Points& x : end) {
    Simulator simulator(ClothSetup(garment, ball));
    ClothState state = AtRest(garment);
    StepStats stats;
    for (int frame = 0; frame < 10; ++frame)
      ASSERT_TRUE(simulator.Advance(
          ball.vertices, ball.vertices, kFrameTime, &state, &stats));
    x = state.x;
  }
  EXPECT_EQ(end[0], end[1]);
}

TEST(Simulator, AFailureLeavesTheStateAlone) {
  const Garment garment = Square(4, 0.3, 0.5);
  SimulatorSetup setup = ClothSetup(garment, Icosphere(0.1, 2));
  Simulator simulator(std::move(setup));
  ClothState state = AtRest(garment);
  state.v(0, 0) = std::numeric_limits<double>::quiet_NaN();
  const Points before = state.x;
  StepStats stats;
  const Points body = Icosphere(0.1, 2).vertices;
  EXPECT_FALSE(simulator.Advance(body, body, kFrameTime, &state, &stats));
  EXPECT_EQ(state.x, before);
  EXPECT_GT(stats.failed, 0);
  int reasons = 0;
  for (const auto& [why, count] : stats.failures) reasons += count;
  EXPECT_EQ(reasons, stats.failed);
}

// A force that is not a number once it is told so.
class BrokenForce : public Effect {
 public:
  explicit BrokenForce(const bool* broken) : broken_(broken) {}
  std::string name() const override { return "broken"; }
  bool conservative() const override { return false; }
  bool stiffness_is_approximate() const override { return false; }
  void AddStencils(BlockPatternBuilder*) const override {}
  void Bind(const BlockPattern&) override {}
  double Energy(const ClothState&) const override { return 0; }
  void AddForce(const ClothState&, Points* force) const override {
    if (*broken_) (*force)(1, 0) = std::numeric_limits<double>::quiet_NaN();
  }
  void AddStiffness(const ClothState&,
                    double,
                    double,
                    BlockMatrix*) const override {}
  void AddTangent(const ClothState&,
                  const Points&,
                  const Points&,
                  double,
                  BlockMatrix*,
                  BlockMatrix*) const override {}

 private:
  const bool* broken_;
};

// In contact, where the solver could fall back on the velocity it began with:
// a force that is no number is a failure and not a step that missed its
// tolerance, it is named, and nothing of it is left afterwards.
TEST(Simulator, AForceThatIsNoNumberFailsAndIsForgotten) {
  const Garment garment = Square(6, 0.3, 0.002);
  const TriangleMesh ball = Icosphere(0.1, 3);
  bool broken = false;
  Points end[2];
  for (const bool fails : {false, true}) {
    SimulatorSetup setup = ClothSetup(garment, ball);
    setup.effects.push_back(std::make_unique<BrokenForce>(&broken));
    Simulator simulator(std::move(setup));
    ClothState state = AtRest(garment);
    StepStats stats;
    const auto advance = [&] {
      return simulator.Advance(
          ball.vertices, ball.vertices, kFrameTime, &state, &stats);
    };
    for (int frame = 0; frame < 10; ++frame) ASSERT_TRUE(advance());
    ASSERT_GT(stats.most_contacts, 0);
    if (!fails) {
      simulator.Forget();
    } else {
      broken = true;
      EXPECT_FALSE(advance());
      broken = false;
      EXPECT_EQ(stats.failed, 1);
      EXPECT_EQ(stats.missed, 0);
      EXPECT_EQ(stats.failures.count("the force of broken is not finite"), 1u);
    }
    for (int frame = 0; frame < 3; ++frame) ASSERT_TRUE(advance());
    end[fails] = state.x;
  }
  EXPECT_EQ(end[0], end[1]);
}

// A strip of stiff cloth, stretched to 1.4 times its length over the groove
// between two balls: its middle row is drawn into the groove with a million
// times its weight, and both walls hold it.
TEST(Simulator, AGrooveHoldsClothHoweverHardItIsPulled) {
  const TriangleMesh ball = Icosphere(0.1, 3);
  const int n = static_cast<int>(ball.vertices.cols());
  TriangleMesh balls;
  balls.vertices.resize(3, 2 * n);
  balls.vertices << ball.vertices, ball.vertices;
  balls.vertices.row(0).head(n).array() -= 0.08;
  balls.vertices.row(0).tail(n).array() += 0.08;
  balls.faces.resize(3, 2 * ball.faces.cols());
  balls.faces << ball.faces, ball.faces.array() + n;

  Garment strip = Square(12, 1, 0);
  std::vector<Pin> pins;
  for (int i = 0; i < strip.num_vertices(); ++i) {
    const Vector3d flat = strip.placed.col(i);
    const double angle = M_PI * flat.z(), radius = 0.078;
    strip.placed.col(i) << 0.024 * flat.x(), radius * std::cos(angle),
        radius * std::sin(angle);
    if (std::abs(flat.z()) > 0.49) pins.push_back({i, strip.placed.col(i)});
  }
  strip.rest.row(0) *= 0.024;
  strip.rest.row(1) *= 0.078 * M_PI / 1.4;
  SimulatorSetup setup = ClothSetup(strip, balls);
  setup.effects[2] =
      std::make_unique<Membrane>(strip, IsotropicStretch{2e4, 0.3});
  setup.pins = pins;
  Simulator simulator(std::move(setup));
  ClothState state = AtRest(strip);
  StepStats stats;
  for (int frame = 0; frame < 30; ++frame)
    ASSERT_TRUE(simulator.Advance(
        balls.vertices, balls.vertices, kFrameTime, &state, &stats));
  EXPECT_EQ(stats.missed, 0);
  double hardest = 0, closest = 1;
  const SurfaceIndex surface(balls.vertices, balls.faces);
  for (int i = 0; i < strip.num_vertices(); ++i) {
    hardest = std::max(hardest,
                       simulator.contact_force().col(i).norm() /
                           (kGravity * simulator.mass()[i]));
    closest =
        std::min(closest, surface.Nearest(state.x.col(i)).signed_distance);
  }
  EXPECT_GT(hardest, 1e5);
  EXPECT_GT(closest, simulator.contact_options().thickness - 1e-4);
}

// Heavy cloth between two slabs, within reach of both, thrown against one: that
// contact would yield by 1.5 mm because the other one is there, too.
TEST(Simulator, AContactThatBearsAloneDoesNotYield) {
  const TriangleMesh slabs = TwoSlabs();
  const Garment sheet = Square(4, 0.08, 0.004);
  SimulatorSetup setup = ClothSetup(sheet, slabs);
  setup.mass *= 1e4;
  setup.step.substeps = 1;
  const double thickness = setup.contact.thickness;
  Simulator simulator(std::move(setup));
  ClothState state = AtRest(sheet);
  state.v.row(1).setConstant(-10);
  StepStats stats;
  ASSERT_TRUE(simulator.Advance(
      slabs.vertices, slabs.vertices, 1 / 60.0, &state, &stats));
  EXPECT_EQ(stats.missed, 0);
  EXPECT_EQ(stats.yield_solves, 1);
  EXPECT_LT((state.x.row(1).array() - thickness).abs().maxCoeff(), 1e-8);
}

// Cloth that shoots down one wall of a trough: in one step it gets up to 17 mm
// past the bottom, where no face held it at the start of the step.
TEST(Simulator, FastClothDoesNotSlipIntoAHollow) {
  const TriangleMesh trough = Trough(0.2, 0.06);
  Garment sheet = Square(6, 0.06, 0);
  const Vector3d down = Vector3d(1, -0.3, 0).normalized();
  const Vector3d normal = Vector3d(0.3, 1, 0).normalized();
  for (int i = 0; i < sheet.num_vertices(); ++i) {
    const Vector3d flat = sheet.placed.col(i);
    sheet.placed.col(i) =
        (flat.x() - 0.05) * down + 0.002 * normal + Vector3d(0, 0, flat.z());
  }
  SimulatorSetup setup = ClothSetup(sheet, trough);
  setup.step.substeps = 1;
  Simulator simulator(std::move(setup));
  ClothState state = AtRest(sheet);
  state.v.colwise() = 4 * down;
  StepStats stats;
  const SurfaceIndex surface(trough.vertices, trough.faces);
  double closest = 1;
  for (int step = 0; step < 16; ++step) {
    ASSERT_TRUE(simulator.Advance(
        trough.vertices, trough.vertices, 1 / 240.0, &state, &stats));
    for (const SurfacePoint& p : surface.NearestAll(state.x))
      closest = std::min(closest, p.signed_distance);
  }
  EXPECT_EQ(stats.missed, 0);
  EXPECT_GT(stats.slip_solves, 0);
  EXPECT_LT(stats.slip_solves, 12);
  EXPECT_GT(closest, -1.1e-4);
}

// The paper's toy (fig. 5): cloth falls on a cube whose tilt is the only
// unknown; the loss compares with cloth fallen on an upright cube.
class CubeToy : public testing::Test {
 protected:
  static constexpr int kFrames = 20;
  CubeToy() : cube_(Slab(0.1, 0.2)), garment_(Square(9, 0.34, 0.004)) {
    SimulatorSetup setup = ClothSetup(garment_, cube_);
    setup.contact.friction = 0.3;
    setup.step.substeps = 2;
    setup.step.friction.tolerance = 1e-9;
    simulator_ = std::make_unique<Simulator>(std::move(setup));
    double unused;
    target_ = Fall(0, &unused, nullptr);
  }
  Points Cube(double tilt) const {
    return Exp(tilt * Vector3d::UnitZ()) * cube_.vertices;
  }
  // Falls on the cube, which turns from upright to `tilt` within the first
  // frames; returns the cloth and d(cloth)/d(tilt) through the whole history.
  Points Fall(double tilt, double* loss, double* gradient) {
    ClothState state = AtRest(garment_);
    const int n = 3 * garment_.num_vertices();
    StateColumns d{Columns::Zero(n, 1), Columns::Zero(n, 1)};
    Sensitivity sensitivity(*simulator_);
    const auto angle = [&](int f) { return tilt * std::min(1.0, f / 5.0); };
    for (int f = 0; f < kFrames; ++f) {
      FrameRecord record;
      StepStats stats;
      EXPECT_TRUE(simulator_->Advance(Cube(angle(f)),
                                      Cube(angle(f + 1)),
                                      kFrameTime,
                                      &state,
                                      &stats,
                                      &record));
      if (!gradient) continue;
      const std::vector<int> vertices =
          Sensitivity::BodyVertices(cube_.faces, record);
      Columns body[2];
      for (int end : {0, 1}) {
        body[end].resize(3 * vertices.size(), 1);
        const double share = std::min(1.0, (f + end) / 5.0);
        const Points rate =
            share * Cross(Vector3d::UnitZ()) * Cube(angle(f + end));
        for (size_t k = 0; k < vertices.size(); ++k)
          body[end].col(0).segment<3>(3 * k) = rate.col(vertices[k]);
      }
      StateColumns next;
      EXPECT_TRUE(
          sensitivity.Forward(record, vertices, body[0], body[1], &d, &next));
      d = next;
    }
    if (target_.size() > 0) {
      const VectorXd r = Stacked(state.x) - Stacked(target_);
      *loss = 0.5 * r.squaredNorm();
      if (gradient) *gradient = r.dot(d.x.col(0));
    }
    return state.x;
  }
  TriangleMesh cube_;
  Garment garment_;
  std::unique_ptr<Simulator> simulator_;
  Points target_;
};

TEST_F(CubeToy, TiltDerivativeMatchesDifferences) {
  double loss, gradient, plus, minus;
  const double tilt = 0.12;
  Fall(tilt, &loss, &gradient);
  double best = 1e9;
  for (double h : {1e-5, 1e-6, 1e-7}) {
    Fall(tilt + h, &plus, nullptr);
    Fall(tilt - h, &minus, nullptr);
    const double numeric = (plus - minus) / (2 * h);
    best = std::min(best, std::abs(numeric - gradient) / std::abs(numeric));
  }
  EXPECT_LT(best, 1e-3);
}

TEST_F(CubeToy, PlainDescentFindsTheUprightCube) {
  double tilt = 0.15, loss, gradient;
  Fall(tilt, &loss, &gradient);
  double step = 0.05 / std::abs(gradient);
  for (int k = 0; k < 40 && std::abs(tilt) > 0.1 * M_PI / 180; ++k) {
    double trial_loss, trial_gradient;
    const double trial = tilt - step * gradient;
    Fall(trial, &trial_loss, &trial_gradient);
    if (trial_loss < loss) {
      tilt = trial;
      loss = trial_loss;
      gradient = trial_gradient;
      step *= 1.5;
    } else {
      step *= 0.3;
    }
  }
  EXPECT_LT(std::abs(tilt) * 180 / M_PI, 0.1);
}

}  // namespace
}  // namespace invsim
