// SPDX-License-Identifier: Apache-2.0
// Cloth against itself: what holds for every step, and layers at work.
#include "invsim/cloth/effects/self_contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geometry/triangle_crossing.h"
#include "sphere_scene.h"

namespace invsim {
namespace {

constexpr double kFrame = 1 / 60.0;
constexpr double kFall = 9.81;

class SelfContactTest : public testing::Test {
 protected:
  // `gravity` 0 leaves it out.
  void Make(const Garment& garment,
            const SelfContactOptions& options,
            double gravity = kFall,
            const TriangleMesh& body = {},
            std::vector<Pin> pins = {}) {
    garment_ = garment;
    SimulatorSetup setup = ClothSetup(garment, body);
    GravityOptions down;
    down.acceleration = gravity * direction_;
    setup.effects[1] = std::make_unique<Gravity>(setup.mass, down);
    setup.effects.push_back(std::make_unique<SelfContact>(garment, options));
    setup.pins = std::move(pins);
    setup.step.friction.tolerance = 1e-7;
    body_ = body.vertices;
    simulator_ = std::make_unique<Simulator>(std::move(setup));
    state_ = AtRest(garment);
  }
  void Run(int frames) {
    for (int k = 0; k < frames; ++k) {
      ASSERT_TRUE(simulator_->Advance(body_, body_, kFrame, &state_, &stats_));
      ASSERT_EQ(CountCrossings(state_.x, garment_.faces), 0) << "frame " << k;
    }
    EXPECT_EQ(stats_.missed, 0);
  }
  // Pins all of the first `n` vertices where they are.
  static std::vector<Pin> Hold(const Garment& garment, int n) {
    std::vector<Pin> pins;
    for (int i = 0; i < n; ++i) pins.push_back({i, garment.placed.col(i)});
    return pins;
  }
  Vector3d Momentum() const { return state_.v * simulator_->mass(); }

  Vector3d direction_ = -Vector3d::UnitY();
  Garment garment_;
  Points body_;
  std::unique_ptr<Simulator> simulator_;
  ClothState state_;
  StepStats stats_;
};

// The lower piece is a table of 9 x 9 held vertices; the upper falls on it.
constexpr int kTable = 81;
Garment PieceOnTable(double height) {
  return Together(Square(8, 0.2, 0), Square(5, 0.1, height));
}

TEST_F(SelfContactTest, LayersComeToRestAtTheThickness) {
  const Garment garment = PieceOnTable(0.01);
  SelfContactOptions options;
  Make(garment, options, kFall, {}, Hold(garment, kTable));
  Run(60);
  double lowest = 1, highest = 0;
  for (int i = kTable; i < garment.num_vertices(); ++i) {
    lowest = std::min(lowest, state_.x(1, i));
    highest = std::max(highest, state_.x(1, i));
  }
  // Weight over compliance lets it sink by less than a micrometre.
  EXPECT_GT(lowest, options.thickness - 2e-6);
  EXPECT_LT(highest, options.thickness + 2e-5);
  EXPECT_LT(state_.v.cwiseAbs().maxCoeff(), 1e-3);
  // The table carries the weight of the piece.
  const Points& force = simulator_->contact_force();
  const double weight =
      kFall * simulator_->mass().tail(garment.num_vertices() - kTable).sum();
  EXPECT_NEAR(
      force.rightCols(garment.num_vertices() - kTable).row(1).sum() / weight,
      1,
      1e-4);
}

// On a slope, friction holds the piece below the angle of friction; above it
// the piece slides down with g (sin a - mu cos a).
TEST_F(SelfContactTest, PieceOnASlopeSticksOrSlides) {
  const double mu = 0.4;
  for (const double degrees : {15.0, 35.0}) {
    const double a = degrees * M_PI / 180;
    direction_ = Vector3d(std::sin(a), -std::cos(a), 0);
    const Garment garment = PieceOnTable(0.001);
    Make(garment,
         {.thickness = 0.001, .friction = mu},
         kFall,
         {},
         Hold(garment, kTable));
    const int frames = 10;
    Run(frames);
    const double slope = kFall * std::max(0.0, std::sin(a) - mu * std::cos(a));
    const int n = garment.num_vertices() - kTable;
    const Vector3d mean = state_.v.rightCols(n).rowwise().mean();
    if (slope == 0) {
      // What compliance lets creep: its weight share times g dt.
      EXPECT_LT(mean.norm(), 1e-3 * kFall * frames * kFrame);
    } else {
      EXPECT_NEAR(mean.x(), slope * frames * kFrame, 0.03 * mean.x());
    }
  }
}

// Two free pieces collide; nothing else acts.
TEST_F(SelfContactTest, MomentumIsKept) {
  Make(Together(Square(6, 0.12, 0), Square(4, 0.09, 0.01)), {}, 0);
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  for (int i = 0; i < garment_.num_vertices(); ++i)
    state_.v.col(i) =
        Vector3d(i < 49 ? 0.2 : -0.1, i < 49 ? 1.5 : -1.0, 0.1) +
        0.1 * Vector3d(normal(random), normal(random), normal(random));
  const Vector3d before = Momentum();
  const double energy = simulator_->KineticEnergy(state_);
  double strongest = 0;
  for (int frame = 0; frame < 6; ++frame) {
    Run(1);
    const Points& force = simulator_->contact_force();
    strongest = std::max(strongest, force.norm());
    EXPECT_LE(force.rowwise().sum().norm(), 1e-12 * force.norm());
  }
  EXPECT_GT(strongest, 0.001);
  EXPECT_GT(stats_.most_cloth_contacts, 20);
  const double scale = simulator_->mass().sum();
  EXPECT_LT((Momentum() - before).norm(), 1e-6 * scale);
  EXPECT_LT(simulator_->KineticEnergy(state_), energy);
}

// A hundred times the thickness in one sub-step.
TEST_F(SelfContactTest, FastApproachDoesNotTunnel) {
  for (const double speed : {5.0, 25.0, 100.0}) {
    const Garment garment = PieceOnTable(0.05);
    Make(garment, {}, kFall, {}, Hold(garment, kTable));
    state_.v.rightCols(garment.num_vertices() - kTable)
        .row(1)
        .setConstant(-speed);
    Run(8);
    EXPECT_GT(
        state_.x.rightCols(garment.num_vertices() - kTable).row(1).minCoeff(),
        0)
        << speed;
  }
}

// Without the effect the piece falls through, and nothing of it is left in
// the scene.
TEST_F(SelfContactTest, OffMeansOff) {
  const Garment garment = PieceOnTable(0.01);
  SimulatorSetup setup = ClothSetup(garment, {});
  setup.pins = Hold(garment, kTable);
  Simulator simulator(std::move(setup));
  EXPECT_EQ(simulator.self_contact_options(), nullptr);
  ClothState state = AtRest(garment);
  StepStats stats;
  FrameRecord record;
  for (int k = 0; k < 12; ++k)
    ASSERT_TRUE(simulator.Advance({}, {}, kFrame, &state, &stats, &record));
  EXPECT_LT(state.x(1, garment.num_vertices() - 1), -0.05);
  EXPECT_EQ(stats.most_cloth_contacts, 0);
  EXPECT_TRUE(record.substeps[0].cloth_sources.empty());
}

// A strip whose one end is lifted and turned over falls on the other end, over
// a rounded edge of the table.
TEST_F(SelfContactTest, StripFoldsOntoItself) {
  Garment strip = Square(10, 0.24, 0);
  for (int i = 0; i < strip.num_vertices(); ++i) {
    // Beyond the middle the strip stands up and bends over: a quarter circle
    // and on.
    Vector3d p = strip.placed.col(i);
    const double s = p.x() - 0.02, radius = 0.02;
    if (s > 0) {
      const double angle = std::min(s / radius, 0.75 * M_PI);
      const double rest = s - radius * angle;
      p.x() = 0.02 + radius * std::sin(angle) + rest * std::cos(angle);
      p.y() = radius * (1 - std::cos(angle)) + rest * std::sin(angle);
    }
    strip.placed.col(i) = p;
  }
  SelfContactOptions options;
  Make(strip, options, kFall, Slab(0.3, 0.1));
  body_.row(1).array() -= 0.002;
  Run(40);
  EXPECT_GT(stats_.most_cloth_contacts, 50);
  // The upper half lies on the lower.
  int above = 0;
  for (int i = 0; i < strip.num_vertices(); ++i) above += state_.x(1, i) < 0.01;
  EXPECT_GT(above, 0.8 * strip.num_vertices());
}

// A sheet hung up by a corner region and dropped crumples on itself.
TEST_F(SelfContactTest, SheetDroppedOnEdgeCrumplesWithoutCrossing) {
  Garment sheet = Square(12, 0.25, 0);
  for (int i = 0; i < sheet.num_vertices(); ++i) {
    const Vector3d p = sheet.placed.col(i);
    sheet.placed.col(i) = Vector3d(
        p.x(), 0.13 + p.z(), 0.004 * std::sin(40 * p.x()) + 0.05 * p.z());
  }
  Make(sheet, {}, kFall, Slab(0.3, 0.1));
  Run(40);
  EXPECT_GT(stats_.most_cloth_contacts, 50);
}

// Cloth that crosses itself at the start: a corner of the upper piece is stuck
// through the lower one.
class TangledTest : public SelfContactTest {
 protected:
  TangledTest() {
    Garment garment = Together(Square(8, 0.2, 0), Square(8, 0.21, 0.004));
    for (int i = 81; i < 162; ++i) {
      Vector3d p = garment.placed.col(i) + Vector3d(0.003, 0, 0.007);
      const double reach = (p - Vector3d(0.11, 0.004, 0.11)).norm();
      p.y() -= 0.3 * std::max(0.0, 0.05 - reach);
      garment.placed.col(i) = p;
    }
    Make(garment, {}, 0);
    before_ = CountCrossings(state_.x, garment.faces);
  }
  void Advance(int frames) {
    for (int k = 0; k < frames; ++k)
      ASSERT_TRUE(simulator_->Advance(body_, body_, kFrame, &state_, &stats_));
    EXPECT_EQ(stats_.missed, 0) << stats_.worst_residual;
  }
  int before_;
};

TEST_F(TangledTest, IsSaidAndGetsNoWorse) {
  ASSERT_GT(before_, 2);
  const double energy = simulator_->PotentialEnergy(state_);
  Advance(40);
  EXPECT_GE(stats_.most_crossings, before_);
  EXPECT_LE(CountCrossings(state_.x, garment_.faces), before_);
  EXPECT_LT(simulator_->KineticEnergy(state_), energy);
}

// Nothing holds the corner back; once free, it stays on its side.
TEST_F(TangledTest, ComesFreeWhenPulled) {
  state_.v.rightCols(81).row(1).setConstant(0.3);
  Advance(10);
  EXPECT_EQ(CountCrossings(state_.x, garment_.faces), 0);
  state_.v.rightCols(81).row(1).array() -= 1.0;
  Run(20);
}

}  // namespace
}  // namespace invsim
