// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/hard_fit.h"

#include <algorithm>
#include <cmath>

#include "hard_fit_cases.h"
#include "invsim/base/error.h"
#include "invsim/base/stopwatch.h"
#include "invsim/body/mannequin.h"
#include "invsim/cloth/named_materials.h"
#include "invsim/study/optimizer_comparison.h"

namespace invsim {
namespace {

constexpr double kFitRate = 30;

bool Finite(const BodySequence& body) {
  bool finite = body.shape.allFinite();
  for (int t = 0; t < body.num_frames(); ++t)
    finite =
        finite && body.poses[t].allFinite() && body.translations[t].allFinite();
  return finite;
}

bool Finite(const Uncertainty& u) {
  bool finite = u.shape_covariance.allFinite();
  for (const PoseVector& deviation : u.pose_deviation)
    finite = finite && deviation.allFinite();
  for (const Vector3d& deviation : u.translation_deviation)
    finite = finite && deviation.allFinite();
  return finite;
}

std::string InMillimetres(double metres) {
  return std::to_string(std::lround(1e3 * metres)) + " mm";
}

// What of the promises of hard_fit.h an optimiser's summary breaks.
void JudgeOptimizer(const OptimizerSummary& s,
                    std::vector<std::string>* broken) {
  if (s.usable() &&
      !(std::isfinite(s.initial_cost) && std::isfinite(s.final_cost)))
    broken->push_back("a cost is not finite");
  if (s.usable() && s.final_cost > s.initial_cost)
    broken->push_back("the cost rose");
  double last = std::numeric_limits<double>::infinity();
  for (const IterationRecord& i : s.iterations) {
    if (!(i.cost <= last)) broken->push_back("the cost rose on the way");
    last = i.cost;
  }
}

bool EveryFailureHasACause(const FitResult& r) {
  int causes = r.counts().no_derivative;
  for (const auto& [why, count] : r.stats.step.failures) causes += count;
  return causes >= r.counts().failed;
}

void Judge(const HardFit& fit, bool cloth_finite, HardFitOutcome* o) {
  const FitResult& r = o->result;
  const auto fail = [&](const std::string& text) { o->broken.push_back(text); };
  if (!Finite(r.body)) fail("the body is not finite");
  if (!cloth_finite) fail("the cloth is not finite");
  if (r.uncertainty && r.uncertainty->failure.empty() &&
      !Finite(*r.uncertainty))
    fail("the uncertainty is not finite");
  for (const FitRound& round : r.rounds)
    if (round.optimizer) JudgeOptimizer(*round.optimizer, &o->broken);
  if (!EveryFailureHasACause(r))
    fail("evaluations failed without a reason given");
  if (std::find(fit.ends.begin(), fit.ends.end(), r.termination) ==
      fit.ends.end())
    fail(std::string("ended as ") + Name(r.termination) + ": " + r.reason);
  if (r.usable() != fit.usable)
    fail(r.usable() ? "usable against expectation" : "not usable");
  if (r.reason.empty()) fail("no reason given");
  if (o->body_error > fit.body_error)
    fail("body off by " + InMillimetres(o->body_error));
  const std::string further = fit.check ? fit.check(r) : "";
  if (!further.empty()) fail(further);
}

}  // namespace

HardFitOutcome RunHardFit(HardFit fit) {
  const Stopwatch watch;
  const BodyModel& body = Mannequin();
  HardFitOutcome outcome;
  CheckGarmentFits(fit.garment, body, ShapeVector::Zero(), "the garment");
  SimulatorSetup setup =
      MakeSetup(fit.scene, body, fit.garment, FindMaterial(fit.scene.material));
  if (fit.fault) setup.effects.push_back(std::move(fit.fault));
  Simulator simulator(std::move(setup));
  bool cloth_finite = true;
  FitObserver observer;
  observer.iteration = [&](const FitIteration& i) {
    if (fit.on_iteration) fit.on_iteration(i.record);
    return true;
  };
  observer.frame = [&](const SimulatedFrame& f) {
    cloth_finite =
        cloth_finite && f.cloth.x.allFinite() && f.cloth.v.allFinite();
  };
  FitScene scene{body,
                 fit.garment,
                 [&](const BodySequence&) { return &simulator; },
                 fit.clouds,
                 kFitRate,
                 fit.start};
  outcome.result = FitSequence(scene, fit.fit, observer);
  if (fit.truth) {
    if (fit.start)
      outcome.start_error = BodyError(body, *fit.start, *fit.truth);
    outcome.body_error = BodyError(body, outcome.result.body, *fit.truth);
  }
  Judge(fit, cloth_finite, &outcome);
  outcome.seconds = watch.seconds();
  return outcome;
}

HardFitOutcome RunHardFitCase(const HardFitCase& hard) {
  HardFit fit = hard.make();
  try {
    HardFitOutcome outcome = RunHardFit(std::move(fit));
    if (!hard.refusal.empty())
      outcome.broken.push_back("taken, though bad input");
    return outcome;
  } catch (const InputError& error) {
    HardFitOutcome outcome;
    outcome.refused = true;
    outcome.refusal = error.what();
    if (hard.refusal.empty() ||
        outcome.refusal.find(hard.refusal) == std::string::npos)
      outcome.broken.push_back(outcome.refusal);
    if (outcome.refusal.find('\n') != std::string::npos)
      outcome.broken.push_back("refused with more than one line");
    return outcome;
  }
}

const std::vector<HardFitCase>& HardFitCases() {
  static const std::vector<HardFitCase> cases = [] {
    std::vector<HardFitCase> all;
    AddDataCases(&all);
    AddOptimiserCases(&all);
    return all;
  }();
  return cases;
}

}  // namespace invsim
