// SPDX-License-Identifier: Apache-2.0
#include "invsim/sim/sensitivity.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/shapes.h"
#include "invsim/cloth/effects/mass_damping.h"
#include "invsim/cloth/effects/self_contact.h"
#include "sphere_scene.h"

namespace invsim {
namespace {

// A sphere turned by `angle` about z, shifted and scaled by the parameters
// (shift 3, angle, scale): what the derivative is taken with respect to.
constexpr int kParameters = 5;
using Parameters = Eigen::Matrix<double, kParameters, 1>;

Points Place(const Points& sphere, const Parameters& p) {
  const Matrix3d r =
      Eigen::AngleAxisd(p[3], Vector3d::UnitZ()).toRotationMatrix();
  Points out = (1 + p[4]) * (r * sphere);
  out.colwise() += Vector3d(p.head<3>());
  return out;
}

struct Case {
  const char* name;
  double friction;
  int substeps;
  int newton_iterations;
  bool inertia = true;
  bool layers = false;  // a second piece of cloth on the first
  bool hollow = false;  // shot across a trough instead of laid on a sphere
};

class SensitivityTest : public testing::TestWithParam<Case> {
 protected:
  // Cloth that has settled on the sphere for a while, then one more frame in
  // which the sphere moves, is differentiated.
  void SetUp() override {
    const Case& c = GetParam();
    sphere_ = Icosphere(0.12, 3);
    garment_ = Square(10, 0.35, 0.135);
    if (c.layers)
      garment_ = Together(Square(6, 0.3, 0.135), Square(4, 0.15, 0.137));
    if (c.hollow) {
      sphere_ = Trough(0.2, 0.06);
      garment_ = Square(6, 0.12, 0);
      for (int i = 0; i < garment_.num_vertices(); ++i) {
        const Vector3d flat = garment_.placed.col(i);
        garment_.placed.col(i) = (flat.x() - 0.065) * kDown + 0.002 * kNormal +
                                 Vector3d(0, 0, flat.z());
      }
    }
    SimulatorSetup setup = ClothSetup(garment_, sphere_);
    if (c.layers)
      setup.effects.push_back(std::make_unique<SelfContact>(
          garment_, SelfContactOptions{.friction = 0.25}));
    // Quasi-static cloth needs something that resists moving freely.
    if (!c.inertia)
      setup.effects[0] = std::make_unique<MassDamping>(
          setup.mass, MassDampingOptions{.rate = 60});
    setup.contact.friction = c.friction;
    setup.step.substeps = c.substeps;
    setup.step.newton_iterations = c.newton_iterations;
    setup.step.friction.tolerance = 1e-11;
    simulator_ = std::make_unique<Simulator>(std::move(setup));
    start_ = AtRest(garment_);
    StepStats stats;
    for (int frame = 0; frame < 8; ++frame)
      ASSERT_TRUE(simulator_->Advance(
          sphere_.vertices, sphere_.vertices, kFrame, &start_, &stats));
    // Taut: slack triangles pass between tension and compression all the time.
    if (c.hollow) {
      const Vector3d middle = start_.x.rowwise().mean();
      for (auto x : start_.x.colwise())
        x += 0.03 * (x - middle - (x - middle).dot(kNormal) * kNormal);
      start_.v.colwise() += 2.1 * kDown;
    }
    p_ << 0.004, 0.003, -0.002, 0.06, 0.002;
    ASSERT_TRUE(Run(p_, &record_, &end_, &stats_));
    EXPECT_EQ(stats_.missed, 0);
    vertices_ = Sensitivity::BodyVertices(simulator_->body_faces(), record_);
    EXPECT_EQ(FixedContacts(record_), 0);
    EXPECT_EQ(stats_.most_cloth_contacts > 10, c.layers);
    EXPECT_EQ(stats_.slip_solves > 0, c.hollow);
  }

  bool Run(const Parameters& p,
           FrameRecord* record,
           ClothState* end,
           StepStats* stats) {
    *end = start_;
    return simulator_->Advance(sphere_.vertices,
                               Place(sphere_.vertices, p),
                               kFrame,
                               end,
                               stats,
                               record);
  }

  // d(body vertices at the end)/d(parameters) of the listed vertices.
  Columns BodyJacobian() const {
    Columns j(3 * vertices_.size(), kParameters);
    const double h = 1e-6;
    for (int k = 0; k < kParameters; ++k) {
      const Points d = (Place(sphere_.vertices, p_ + h * Parameters::Unit(k)) -
                        Place(sphere_.vertices, p_ - h * Parameters::Unit(k))) /
                       (2 * h);
      for (size_t i = 0; i < vertices_.size(); ++i)
        j.col(k).segment<3>(3 * i) = d.col(vertices_[i]);
    }
    return j;
  }

  static constexpr double kFrame = 1 / 60.0;
  // Of the trough's wall at x < 0.
  inline static const Vector3d kDown = Vector3d(1, -0.3, 0).normalized();
  inline static const Vector3d kNormal = Vector3d(0.3, 1, 0).normalized();
  TriangleMesh sphere_;
  Garment garment_;
  std::unique_ptr<Simulator> simulator_;
  ClothState start_, end_;
  Parameters p_;
  FrameRecord record_;
  StepStats stats_;
  std::vector<int> vertices_;
};

TEST_P(SensitivityTest, ForwardMatchesDifferencesWhileSetsStay) {
  Sensitivity sensitivity(*simulator_);
  StateColumns d;
  ASSERT_TRUE(sensitivity.Forward(
      record_, vertices_, Columns(), BodyJacobian(), nullptr, &d));
  int compared = 0;
  for (int k = 0; k < kParameters; ++k) {
    double best = 1e9;
    for (double h : {1e-5, 1e-6, 1e-7, 1e-8}) {
      if (best < 1e-6) break;
      VectorXd difference[2];
      bool same = true;
      for (int order : {1, 2}) {
        ClothState plus, minus;
        FrameRecord rp, rm;
        StepStats stats;
        const Parameters dp = order * h * Parameters::Unit(k);
        ASSERT_TRUE(Run(p_ + dp, &rp, &plus, &stats));
        ASSERT_TRUE(Run(p_ - dp, &rm, &minus, &stats));
        same = same && SameContacts(record_, rp) && SameContacts(record_, rm);
        difference[order - 1] =
            (Stacked(plus.x) - Stacked(minus.x)) / (2 * order * h);
      }
      if (!same) continue;
      const VectorXd numeric = (4 * difference[0] - difference[1]) / 3;
      best = std::min(best, (d.x.col(k) - numeric).norm() / numeric.norm());
    }
    if (best > 1e8) continue;  // sets switch at every step tried
    ++compared;
    EXPECT_LT(best, 1e-6) << "parameter " << k;
  }
  EXPECT_GE(compared, 3);
  RecordProperty("stick", stats_.stick);
  RecordProperty("slide", stats_.slide);
}

TEST_P(SensitivityTest, AdjointIsTheTranspose) {
  Sensitivity sensitivity(*simulator_);
  const int n = 3 * simulator_->num_vertices();
  const int m = 3 * static_cast<int>(vertices_.size());
  std::srand(3);
  const Columns body0 = MatrixXd::Random(m, 2), body1 = MatrixXd::Random(m, 2);
  const StateColumns start{MatrixXd::Random(n, 2), MatrixXd::Random(n, 2)};
  const StateColumns weights{MatrixXd::Random(n, 3), MatrixXd::Random(n, 3)};
  StateColumns end, start_weights;
  Columns w0, w1;
  ASSERT_TRUE(
      sensitivity.Forward(record_, vertices_, body0, body1, &start, &end));
  ASSERT_TRUE(sensitivity.Adjoint(
      record_, vertices_, weights, &w0, &w1, &start_weights));
  const MatrixXd forward =
      weights.x.transpose() * end.x + weights.v.transpose() * end.v;
  const MatrixXd adjoint = w0.transpose() * body0 + w1.transpose() * body1 +
                           start_weights.x.transpose() * start.x +
                           start_weights.v.transpose() * start.v;
  EXPECT_LT((forward - adjoint).norm(), 1e-10 * forward.norm());
}

TEST_P(SensitivityTest, StartOfFrameMatchesDifferences) {
  Sensitivity sensitivity(*simulator_);
  const int n = 3 * simulator_->num_vertices();
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  StateColumns start{Columns(n, 1), Columns(n, 1)}, d;
  for (int i = 0; i < n; ++i) {
    start.x(i, 0) = normal(random);
    start.v(i, 0) = 10 * normal(random);
  }
  ASSERT_TRUE(sensitivity.Forward(
      record_, vertices_, Columns(), Columns(), &start, &d));
  const auto run = [&](double step, FrameRecord* record) -> VectorXd {
    const ClothState saved = start_;
    Stacked(start_.x) += step * start.x.col(0);
    Stacked(start_.v) += step * start.v.col(0);
    ClothState end;
    StepStats stats;
    EXPECT_TRUE(Run(p_, record, &end, &stats));
    start_ = saved;
    return Stacked(end.x);
  };
  double best = 1e9;
  // Small steps: nearly slack triangles pass between tension and compression,
  // where the frozen stiffness has a kink that SameContacts does not see.
  for (double h : {1e-7, 1e-8, 1e-9, 1e-10}) {
    VectorXd difference[2];
    bool same = true;
    for (int order : {1, 2}) {
      FrameRecord plus, minus;
      difference[order - 1] =
          (run(order * h, &plus) - run(-order * h, &minus)) / (2 * order * h);
      same =
          same && SameContacts(record_, plus) && SameContacts(record_, minus);
    }
    const VectorXd numeric = (4 * difference[0] - difference[1]) / 3;
    const double error = (d.x.col(0) - numeric).norm() / numeric.norm();
    if (same) best = std::min(best, error);
  }
  EXPECT_LT(best, 1e-5);
}

// Cloth that contacts made exact keep out (StepContacts::Stiffen) goes with
// the slab it is pressed on, and slides on it as far as friction lets it.
TEST(Sensitivity, OfContactsMadeExactMatchesDifferences) {
  const TriangleMesh slabs = TwoSlabs();
  const Garment sheet = Square(4, 0.08, 0.004);
  SimulatorSetup setup = ClothSetup(sheet, slabs);
  setup.mass *= 1e4;
  setup.step.substeps = 1;
  setup.step.friction.tolerance = 1e-11;
  Simulator simulator(std::move(setup));
  const auto run = [&](const Vector3d& shift, FrameRecord* record) {
    ClothState state = AtRest(sheet);
    state.v.colwise() = Vector3d(5, -10, 0);
    StepStats stats;
    EXPECT_TRUE(simulator.Advance(slabs.vertices,
                                  slabs.vertices.colwise() + shift,
                                  1 / 60.0,
                                  &state,
                                  &stats,
                                  record));
    EXPECT_EQ(stats.yield_solves, 1);
    EXPECT_GT(stats.slide, 0);
    return VectorXd(Stacked(state.x));
  };
  FrameRecord record;
  run(Vector3d::Zero(), &record);
  const std::vector<int> vertices =
      Sensitivity::BodyVertices(simulator.body_faces(), record);
  const Columns shift = MatrixXd::Identity(3, 3).replicate(vertices.size(), 1);
  StateColumns d;
  ASSERT_TRUE(Sensitivity(simulator).Forward(
      record, vertices, Columns(), shift, nullptr, &d));
  for (int k = 0; k < 3; ++k) {
    const Vector3d h = 1e-6 * Vector3d::Unit(k);
    FrameRecord plus, minus;
    const VectorXd numeric = (run(h, &plus) - run(-h, &minus)) / 2e-6;
    EXPECT_TRUE(SameContacts(record, plus) && SameContacts(record, minus));
    // By a vertex of 25: along the way it slides nothing moves it.
    EXPECT_LT((d.x.col(k) - numeric).norm(), 1e-6 * 5) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Scenes,
    SensitivityTest,
    testing::Values(Case{"OneSubstep", 0.3, 1, 1},
                    Case{"Frictionless", 0.0, 2, 1},
                    Case{"SlideAndStick", 0.3, 3, 1},
                    Case{"MostlyStick", 2.0, 3, 1},
                    Case{"Relinearised", 0.3, 2, 3},
                    Case{"QuasiStatic", 0.5, 2, 1, false},
                    Case{"Layers", 0.3, 3, 1, true, true},
                    Case{"RelinearisedLayers", 0.3, 2, 3, true, true},
                    Case{"Hollow", 0.3, 2, 1, true, false, true},
                    Case{"RelinearisedHollow", 0.3, 2, 3, true, false, true}),
    [](const auto& c) { return std::string(c.param.name); });

}  // namespace
}  // namespace invsim
