// SPDX-License-Identifier: Apache-2.0
#include <ceres/manifold.h>
#include <ceres/problem.h>

#include <algorithm>
#include <cmath>

#include "invsim/base/stopwatch.h"
#include "invsim/fit/optimizer.h"

namespace invsim {
namespace {

// Armijo: a step must bring this share of what the gradient promises.
constexpr double kSufficient = 1e-4;
constexpr int kMaxHalvings = 30;

// The free parameters of the problem in Ceres's order.
class Point {
 public:
  explicit Point(Objective* objective)
      : problem_(objective->problem()), blocks_(objective->blocks()) {
    Save();
  }

  void Save() {
    saved_.clear();
    for (double* block : blocks_)
      saved_.insert(
          saved_.end(), block, block + problem_->ParameterBlockSize(block));
  }

  // The saved point less `step` times the gradient, which is given in the
  // tangent space of each block's manifold.
  void Move(const std::vector<double>& gradient, double step) {
    size_t at = 0, tangent = 0;
    for (double* block : blocks_) {
      const int size = problem_->ParameterBlockSize(block);
      const int free = problem_->ParameterBlockTangentSize(block);
      std::vector<double> delta(free);
      for (int i = 0; i < free; ++i) delta[i] = -step * gradient[tangent + i];
      const double* from = saved_.data() + at;
      if (const ceres::Manifold* manifold = problem_->GetManifold(block))
        manifold->Plus(from, delta.data(), block);
      else
        for (int i = 0; i < size; ++i) block[i] = from[i] + delta[i];
      at += size;
      tangent += free;
    }
  }

  void Restore() {
    size_t at = 0;
    for (double* block : blocks_) {
      const int size = problem_->ParameterBlockSize(block);
      std::copy_n(saved_.data() + at, size, block);
      at += size;
    }
  }

 private:
  ceres::Problem* problem_;
  const std::vector<double*>& blocks_;
  std::vector<double> saved_;
};

double SquaredNorm(const std::vector<double>& v) {
  double sum = 0;
  for (const double value : v) sum += value * value;
  return sum;
}

double Largest(const std::vector<double>& v) {
  double largest = 0;
  for (const double value : v) largest = std::max(largest, std::abs(value));
  return largest;
}

struct DescentState {
  double cost = 0;
  std::vector<double> gradient;
  double step = 0;
  double moved = 0;
  // Whether a trial of the last or of the last but one step could not be
  // evaluated: at the border every other step is short enough to succeed.
  bool blocked = false;
  bool blocked_now = false;
};

class GradientDescent : public Optimizer {
 public:
  explicit GradientDescent(const GradientDescentOptions& options)
      : options_(options) {}

  OptimizerSummary Run(Objective* objective,
                       const IterationObserver& observer) const override;

 private:
  bool Step(Objective* objective, Point* point, DescentState* s) const;

  GradientDescentOptions options_;
};

enum class Trial { kGood, kTooMuch, kImpossible };

// The cost at x alone, and whether it is at most `limit`.
Trial TryCost(Objective* objective, double limit, double* cost) {
  const int abandoned = objective->counts().abandoned;
  objective->SetCostLimit(limit);
  const bool evaluated = objective->Evaluate(cost, nullptr);
  objective->SetCostLimit(kNoLimit);
  if (evaluated) return *cost <= limit ? Trial::kGood : Trial::kTooMuch;
  return objective->counts().abandoned > abandoned ? Trial::kTooMuch
                                                   : Trial::kImpossible;
}

// The gradient at x, where the cost was evaluated last.
bool Linearize(Objective* objective, std::vector<double>* gradient) {
  double same = 0;
  return objective->Evaluate(&same, gradient);
}

// One step. Fixed: taken whatever it brings, as long as it can be evaluated.
// False if there is none to take. The derivative is found of a point that is
// kept, not of trials.
bool GradientDescent::Step(Objective* objective,
                           Point* point,
                           DescentState* s) const {
  const double slope = SquaredNorm(s->gradient);
  s->blocked = s->blocked_now;
  s->blocked_now = false;
  for (int halvings = 0; halvings <= kMaxHalvings; ++halvings) {
    point->Move(s->gradient, s->step);
    const double limit = options_.backtracking
                             ? s->cost - kSufficient * s->step * slope
                             : kNoLimit;
    double cost = 0;
    std::vector<double> gradient;
    Trial trial = TryCost(objective, limit, &cost);
    if (trial == Trial::kGood && !Linearize(objective, &gradient))
      trial = Trial::kImpossible;
    if (trial == Trial::kImpossible) s->blocked = s->blocked_now = true;
    if (trial == Trial::kGood) {
      s->moved = s->step * std::sqrt(slope);
      s->cost = cost;
      s->gradient = std::move(gradient);
      point->Save();
      if (options_.backtracking && halvings == 0) s->step *= 2;
      return true;
    }
    if (!options_.backtracking) break;
    s->step /= 2;
  }
  point->Restore();
  return false;
}

OptimizerSummary GradientDescent::Run(Objective* objective,
                                      const IterationObserver& observer) const {
  const Stopwatch watch;
  OptimizerSummary summary;
  DescentState s;
  s.step = options_.step;
  if (TryCost(objective, kNoLimit, &s.cost) != Trial::kGood ||
      !Linearize(objective, &s.gradient)) {
    summary.reason = "The start cannot be evaluated.";
    summary.counts = objective->counts();
    return summary;
  }
  summary.initial_cost = s.cost;
  Point point(objective);
  summary.termination = Termination::kIterationLimit;
  summary.reason = "The iteration limit was reached.";
  bool converged = false;
  for (int i = 0;; ++i) {
    IterationRecord record;
    record.iteration = i;
    record.cost = s.cost;
    record.gradient_norm = Largest(s.gradient);
    record.step_norm = s.moved;
    record.seconds = watch.seconds();
    record.counts = objective->counts();
    record.terms = objective->terms();
    summary.iterations.push_back(record);
    const bool go_on = !observer || observer(record);
    if (converged) break;
    if (!go_on) {
      summary.termination = Termination::kInterrupted;
      summary.reason = "A stop was asked for.";
      break;
    }
    if (i == options_.iterations) break;
    const double before = s.cost;
    if (!Step(objective, &point, &s)) {
      summary.termination =
          s.blocked ? Termination::kStalled : Termination::kConverged;
      summary.reason = s.blocked
                           ? "No step could be evaluated."
                           : "No step along the gradient lowers the cost.";
      break;
    }
    if (std::abs(before - s.cost) <= options_.function_tolerance * before) {
      summary.termination =
          s.blocked ? Termination::kStalled : Termination::kConverged;
      summary.reason = "The cost changed by less than the tolerance.";
      converged = true;
    }
  }
  summary.final_cost = s.cost;
  summary.seconds = watch.seconds();
  summary.counts = objective->counts();
  return summary;
}

}  // namespace

void Describe(OptionTable* table, GradientDescentOptions* o) {
  table->Add(
      "iterations", &o->iterations, {.doc = "most iterations", .at_least = 0});
  table->Add("step",
             &o->step,
             {.doc = "step along the gradient; the first one if backtracking",
              .above = 0});
  table->Add("backtracking",
             &o->backtracking,
             {.doc = "find the step's length instead of keeping it fixed"});
  table->Add(
      "function_tolerance",
      &o->function_tolerance,
      {.doc = "done when the cost changes by less, relative", .at_least = 0});
}

std::unique_ptr<Optimizer> MakeGradientDescent(
    const GradientDescentOptions& options) {
  return std::make_unique<GradientDescent>(options);
}

}  // namespace invsim
