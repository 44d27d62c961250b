// SPDX-License-Identifier: Apache-2.0

// "auto" on scenes of each kind: the cloth is where it is with everything on,
// to within a tenth of a millimetre, at no more work than a list
// picked by hand.

#include <gmock/gmock.h>

#include <cmath>

#include "invsim/body/rotation.h"
#include "invsim/sim/rollout.h"
#include "invsim/sim/scene.h"
#include "sim/test_scene.h"

namespace invsim {
namespace {

using List = std::vector<std::string>;

constexpr double kRate = 30;         // frames per second
constexpr double kTolerance = 1e-4;  // m, on a sheet of 12 or 25 cm

// A kind of scene: how the ball moves, what is set, what an expert would list.
struct Kind {
  std::string name;
  std::string toml;
  double speed;  // of the ball along x, m/s, gathered in half the sequence
  List by_hand;
  int frames = 20;
};

void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

std::vector<Kind> Kinds() {
  const List usual = {"inertia", "gravity", "membrane", "bending"};
  List dragged = usual, damped = usual;
  dragged.insert(dragged.end(), {"mass_damping", "air_drag"});
  damped.insert(damped.end(), {"stiffness_damping"});
  List loose = usual;
  loose.push_back("self_contact");
  return {{"StandsStill", "", 0, usual},
          {"MovesSlowly", "", 0.05, usual},
          {"Drapes", "", 0.05, loose},
          // With so much friction that it holds for sure: at 0.3 the ball sets
          // out with just what makes the sheet slip.
          {"MovesFast", "contact.friction = 0.6", 1.0, dragged},
          {"StandsInTheWind",
           "effects.air_drag.wind = [1, 0, 0]",
           0,
           {"inertia", "gravity", "membrane", "bending", "air_drag"}},
          // Not for long: on a sheet that slides off a ball every difference
          // grows tenfold in a tenth of a second.
          {"Slips",
           "contact.friction = 0\n"
           "relaxation = {settle_seconds = 0.05, move_seconds = 0.05, "
           "hold_seconds = 0}",
           0.05,
           dragged,
           4},
          {"ShortSteps", "step.substeps = 12", 0.05, damped},
          {"NearlyLimp", "", 0, {"inertia", "gravity", "membrane"}},
          {"InTreacle",
           "effects.mass_damping.rate = 40",
           0.002,
           {"gravity", "membrane", "bending", "mass_damping"}},
          {"OfMeasuredFabric", "", 0.05, usual}};
}

struct Outcome {
  std::vector<Points> cloth;  // per frame
  int effects = 0;
  int blocks = 0;
  StepStats work;
};

class AutoEffects : public ::testing::TestWithParam<Kind> {
 protected:
  AutoEffects() {
    const int swing = GetParam().frames / 2;
    for (int t = 0; t < GetParam().frames; ++t) {
      BodyParameters frame;
      const double s = std::min(t, swing) / kRate;
      frame.translation.x() =
          GetParam().speed *
          (0.5 * s * s * kRate / swing + std::max(0, t - swing) / kRate);
      motion_.push_back(frame);
    }
    if (GetParam().name == "NearlyLimp")
      cloth_.bending = IsotropicBending{1e-8};
    if (GetParam().name == "OfMeasuredFabric") {
      cloth_.stretch = ExampleStretchTable();
      cloth_.bending = ExampleBendingTable();
    }
  }

  Outcome Run(const List& effects) {
    SceneOptions scene;
    OptionTable table;
    RelaxationOptions relaxation;
    Describe(&table, &scene);
    table.AddSection("relaxation", &relaxation);
    scene.contact.friction = 0.3;
    table.Read(Config::FromText(GetParam().toml, "kind"));
    scene.effects = effects;
    const RelaxationScene dressing{body_, sheet_, motion_, kRate};
    scene.decisions = DecideEffects(
        scene,
        sheet_,
        cloth_,
        MeasureMotion(dressing, relaxation, LayerThickness(scene)));
    Simulator simulator(MakeSetup(scene, body_, sheet_, cloth_));
    const RelaxationResult dressed = Relax(dressing, relaxation, &simulator);
    ClothState state = dressed.cloth;
    Outcome out;
    out.work = dressed.stats.step;
    const RolloutResult run = SimulateSequence(
        &simulator,
        [&](int t) { return body_.Vertices(motion_[t]); },
        GetParam().frames,
        kRate,
        &state,
        [&](const SimulatedFrame& f) { out.cloth.push_back(f.cloth.x); });
    EXPECT_EQ(run.status, RunStatus::kComplete);
    out.work.Add(run.stats.step);
    out.effects = static_cast<int>(simulator.effects().size());
    out.blocks = simulator.pattern()->num_blocks();
    return out;
  }

  // Root mean square over vertices and frames, m.
  static double Difference(const Outcome& a, const Outcome& b) {
    double sum = 0, count = 0;
    for (size_t t = 0; t < a.cloth.size(); ++t) {
      sum += (a.cloth[t] - b.cloth[t]).squaredNorm();
      count += static_cast<double>(a.cloth[t].cols());
    }
    return std::sqrt(sum / count);
  }

  BodyModel body_ = BallBody();
  // So small that it cannot touch itself, but for "Drapes".
  Garment sheet_ = SheetAboveBall(8, GetParam().name == "Drapes" ? 0.25 : 0.12);
  Material cloth_ = PlainCloth();
  std::vector<BodyParameters> motion_;
};

TEST_P(AutoEffects, IsEverythingWithinToleranceForNoMoreThanTheListByHand) {
  const Outcome everything = Run(Effects().names());
  const Outcome chosen = Run({"auto"});
  const Outcome by_hand = Run(GetParam().by_hand);
  EXPECT_LE(Difference(chosen, everything), kTolerance);
  EXPECT_LE(chosen.effects, by_hand.effects);
  EXPECT_LT(chosen.effects, everything.effects);
  EXPECT_LE(chosen.blocks, by_hand.blocks);
  EXPECT_LE(chosen.work.factorizations, by_hand.work.factorizations);
  EXPECT_LE(chosen.work.linearizations, by_hand.work.linearizations);
}

INSTANTIATE_TEST_SUITE_P(Scenes,
                         AutoEffects,
                         testing::ValuesIn(Kinds()),
                         [](const auto& p) { return p.param.name; });

}  // namespace
}  // namespace invsim
