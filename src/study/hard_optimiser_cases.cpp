// SPDX-License-Identifier: Apache-2.0

// Hard fits: states in which an optimiser may find itself, and simulations
// that fail at a chosen step.

#include <atomic>
#include <map>
#include <memory>
#include <numbers>
#include <utility>

#include "faulty_effect.h"
#include "hard_fit_cases.h"
#include "invsim/base/joints.h"
#include "invsim/body/mannequin.h"
#include "invsim/body/rotation.h"

namespace invsim {
namespace {

// Strikes `most` times from when it is set off.
class Fuse {
 public:
  explicit Fuse(int most)
      : left_(std::make_shared<std::atomic<int>>(0)), most_(most) {}
  void SetOff() const { *left_ = most_; }
  bool operator()(const ClothState&) const {
    return *left_ > 0 && (*left_)-- > 0;
  }

 private:
  std::shared_ptr<std::atomic<int>> left_;
  int most_;
};

constexpr int kForGood = 1 << 30;

std::string Unless(bool holds, const char* text) { return holds ? "" : text; }

// Three frames, of which nothing but a hand was measured.
HardFit HandOnly() {
  HardFit fit = PlainFit();
  for (int t = 0; t < 3; ++t) {
    const Vector3d hand =
        Mannequin().Joints(fit.truth->Frame(t)).col(kLeftHand);
    const Points& all = fit.clouds[t];
    std::vector<int> near;
    for (int i = 0; i < all.cols(); ++i)
      if ((all.col(i) - hand).norm() < 0.15) near.push_back(i);
    fit.clouds[t] = all(Eigen::all, near).eval();
  }
  MeasureFromPointsAlone(&fit);
  fit.check = [](const FitResult& r) {
    return Unless(r.uncertainty && r.uncertainty->failure.empty() &&
                      r.uncertainty->undetermined_directions >= kNumShape / 2,
                  "the shape is not named as undetermined");
  };
  return fit;
}

// Turned by 60 degrees about the vertical and shifted by a metre. What is torn
// at like that takes long to simulate: one frame, and few steps.
HardFit FarStart() {
  HardFit fit = PlainFit(1);
  const Matrix3d turned = Exp(std::numbers::pi / 3 * Vector3d::UnitY()) *
                          Exp(fit.start->poses[0].head<3>());
  fit.start->poses[0].head<3>() = Log(turned);
  fit.start->translations[0] += Vector3d(1, 0, 0);
  SetOption(&fit, "lm.iterations", "2");
  fit.body_error = 0.9;  // nearer, from 1.02
  return fit;
}

// Frames of a tall and of a small person by turns.
HardFit TwoPeople() {
  HardFit fit = PlainFit(4);
  SetOption(&fit, "lm.iterations", "2");
  const std::vector<Points> tall = HardFitClouds(HardFitTruth(4, 3));
  const std::vector<Points> small = HardFitClouds(HardFitTruth(4, -3));
  for (int t = 0; t < 4; ++t) fit.clouds[t] = t % 2 == 0 ? tall[t] : small[t];
  return fit;
}

// A fault that strikes `times` times, from after iteration `after` on.
HardFit Struck(Fault fault, int after, int times) {
  HardFit fit = PlainFit();
  const Fuse fuse(times);
  fit.fault = MakeFaultyEffect(fault, fuse);
  fit.on_iteration = [=, done = false](const IterationRecord& record) mutable {
    if (done || record.iteration != after) return;
    fuse.SetOff();
    done = true;  // not again after the next dressing
  };
  return fit;
}

// One step fails and is tried again in halves.
HardFit OneBadStep() {
  HardFit fit = Struck(Fault::kForce, 0, 1);
  fit.check = [](const FitResult& r) {
    return Unless(r.counts().failed == 0 && r.stats.step.halved > 0,
                  "not mended by halving");
  };
  fit.body_error = 0.015;
  return fit;
}

// A step and all its halves fail, then everything is well again.
HardFit OneBadEvaluation(Fault fault, const char* cause) {
  // The force is asked once more for the reason.
  const int attempts = StepOptions().max_halvings + 1;
  HardFit fit = Struck(fault, 0, attempts + (fault == Fault::kForce));
  fit.check = [=](const FitResult& r) {
    return Unless(
        r.counts().failed == 1 &&
            r.stats.step.failures == std::map<std::string, int>{{cause, 1}},
        "not counted with its reason");
  };
  fit.body_error = 0.015;
  return fit;
}

// From after the first iteration on there is no derivative.
HardFit NoDerivative() {
  HardFit fit = Struck(Fault::kTangent, 0, kForGood);
  // The derivative of a single step from rest asks for no tangent.
  SetOption(&fit, "step.substeps", "2");
  fit.ends = {Termination::kStalled};
  fit.check = [start = *fit.start](const FitResult& r) {
    const OptimizerSummary& s = *r.optimizer();
    if (s.counts.no_derivative == 0) return "not counted";
    if (r.uncertainty->failure.empty()) return "an uncertainty from nowhere";
    const bool kept = r.body.shape == start.shape &&
                      r.body.translations == start.translations;
    return kept && s.final_cost == s.initial_cost
               ? ""
               : "the point kept is not the one with that cost";
  };
  return fit;
}

// From after the first iteration on nothing can be simulated, not even what
// could be before.
HardFit FailsForGood() {
  HardFit fit = Struck(Fault::kForce, 0, kForGood);
  fit.ends = {Termination::kFailed};
  fit.usable = false;
  return fit;
}

HardFit FailsInDressing() {
  HardFit fit = PlainFit();
  fit.fault = MakeFaultyEffect(Fault::kStiffness,
                               [](const ClothState&) { return true; });
  fit.ends = {Termination::kFailed};
  fit.usable = false;
  fit.check = [](const FitResult& r) {
    return Unless(r.reason.find("dressed") != std::string::npos &&
                      r.reason.find("positive definite") != std::string::npos,
                  "the reason is not given");
  };
  return fit;
}

// Cloth whose middle is more than 2 cm short of where it was measured cannot
// be simulated any further.
HardFit Border() {
  constexpr double kBorder = -0.02, kStart = -0.06;
  HardFit fit = PlainFit();
  fit.start = fit.truth;
  for (Vector3d& translation : fit.start->translations)
    translation.x() += kStart;
  fit.fault = MakeFaultyEffect(Fault::kForce, [](const ClothState& y) {
    return y.x.row(0).mean() > kBorder;
  });
  SetOption(&fit, "lm.iterations", "30");
  fit.ends = {Termination::kStalled};
  return fit;
}

}  // namespace

void AddOptimiserCases(std::vector<HardFitCase>* cases) {
  const auto add =
      [&](const char* name, const char* shows, std::function<HardFit()> make) {
        cases->push_back(
            {std::string("optimiser/") + name, shows, std::move(make)});
      };
  add("hand_only", "a shape of which only a hand was measured", HandOnly);
  add("far_start", "a start turned by 60 degrees, a metre off", FarStart);
  add("two_people", "frames of two people by turns", TwoPeople);
  add("nan_in_a_step", "a force that is not a number, once", OneBadStep);
  add("nan_in_an_evaluation",
      "a force that is not a number until the simulation gives up",
      [] {
        return OneBadEvaluation(Fault::kForce,
                                "the force of fault is not finite");
      });
  add("no_factor",
      "a matrix that cannot be factorised until the simulation gives up",
      [] {
        return OneBadEvaluation(Fault::kStiffness,
                                "the system matrix is not positive definite");
      });
  add("no_derivative", "no derivative after the first step", NoDerivative);
  add("border", "the solution lies where nothing can be simulated", Border);
  add("fails_for_good", "no simulation after the first step", FailsForGood);
  add("fails_in_dressing", "no simulation at all", FailsInDressing);
}

}  // namespace invsim
