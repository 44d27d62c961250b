// SPDX-License-Identifier: Apache-2.0
#include <ceres/iteration_callback.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include "invsim/base/stopwatch.h"
#include "invsim/fit/optimizer.h"

namespace invsim {
namespace {

// Few frames: the Jacobian is small and dense.
constexpr int kDenseFrames = 2;

// Keeps the record of iterations, tells the objective which cost a trial has
// to beat, and passes on the wish to stop.
class Recorder : public ceres::IterationCallback {
 public:
  Recorder(Objective* objective,
           const IterationObserver* observer,
           bool monotone,
           int most_refused)
      : objective_(objective),
        observer_(observer),
        monotone_(monotone),
        most_refused_(most_refused) {}

  ceres::CallbackReturnType operator()(
      const ceres::IterationSummary& summary) override {
    IterationRecord record;
    record.iteration = summary.iteration;
    record.successful = summary.step_is_successful || summary.iteration == 0;
    // Of an unsuccessful step Ceres gives the trial's cost.
    if (record.successful) cost_ = summary.cost;
    record.cost = cost_;
    record.gradient_norm = summary.gradient_max_norm;
    record.step_norm = summary.step_norm;
    record.seconds = watch_.seconds();
    record.counts = objective_->counts();
    if (record.successful) {
      terms_ = objective_->terms();
      kept_ = *objective_->x();
      failed_at_success_ = record.counts.failed;
    }
    record.terms = terms_;
    records.push_back(record);
    if (monotone_) objective_->SetCostLimit(cost_);
    if (*observer_ && !(*observer_)(record)) {
      stopped = true;
      return ceres::SOLVER_TERMINATE_SUCCESSFULLY;
    }
    refused_ = record.successful ? 0 : refused_ + 1;
    exhausted = most_refused_ > 0 && refused_ >= most_refused_;
    return exhausted ? ceres::SOLVER_TERMINATE_SUCCESSFULLY
                     : ceres::SOLVER_CONTINUE;
  }

  // Failed evaluations up to the last successful step.
  int failed_at_success() const { return failed_at_success_; }
  // The point after it.
  const BodySequence& kept() const { return kept_; }

  std::vector<IterationRecord> records;
  bool stopped = false;    // by the observer
  bool exhausted = false;  // too many refused steps in a row

 private:
  Objective* objective_;
  const IterationObserver* observer_;
  bool monotone_;
  int most_refused_;
  int refused_ = 0;
  Stopwatch watch_;
  double cost_ = kNoLimit;
  CostTerms terms_;
  BodySequence kept_;
  int failed_at_success_ = 0;
};

// In place: Ceres knows the blocks by their addresses.
void Assign(const BodySequence& from, BodySequence* to) {
  to->shape = from.shape;
  for (int t = 0; t < from.num_frames(); ++t) {
    to->poses[t] = from.poses[t];
    to->translations[t] = from.translations[t];
  }
}

Termination Classify(const ceres::Solver::Summary& summary,
                     const Objective& objective,
                     const Recorder& recorder) {
  const bool started = !recorder.records.empty();
  if (started && recorder.stopped) return Termination::kInterrupted;
  // Whatever the last steps were: more iterations would go on.
  if (summary.termination_type == ceres::NO_CONVERGENCE)
    return Termination::kIterationLimit;
  // Ceres calls it convergence, or in a line search failure, when no step can
  // be evaluated any more.
  if (started && objective.counts().failed > recorder.failed_at_success())
    return Termination::kStalled;
  if (started && recorder.exhausted) return Termination::kConverged;
  if (!summary.IsSolutionUsable()) return Termination::kFailed;
  return Termination::kConverged;
}

class CeresOptimizer : public Optimizer {
 public:
  // `refused_steps`: zero if it may be any number.
  CeresOptimizer(const CeresOptions& options,
                 ceres::Solver::Options solver,
                 int refused_steps)
      : solver_(std::move(solver)), refused_steps_(refused_steps) {
    solver_.max_num_iterations = options.iterations;
    solver_.function_tolerance = options.function_tolerance;
    solver_.parameter_tolerance = options.parameter_tolerance;
    solver_.gradient_tolerance = options.gradient_tolerance;
    solver_.max_solver_time_in_seconds = kNoLimit;
    solver_.logging_type = ceres::SILENT;
    solver_.num_threads = 1;
    // Observers look at the objective's x.
    solver_.update_state_every_iteration = true;
  }

  bool first_step_gains_most() const override {
    return solver_.minimizer_type == ceres::TRUST_REGION;
  }

  OptimizerSummary Run(Objective* objective,
                       const IterationObserver& observer) const override {
    const Stopwatch watch;
    ceres::Solver::Options solver = solver_;
    const bool monotone = solver.minimizer_type == ceres::TRUST_REGION;
    solver.linear_solver_type = objective->x()->num_frames() <= kDenseFrames
                                    ? ceres::DENSE_QR
                                    : ceres::SPARSE_NORMAL_CHOLESKY;
    Recorder recorder(objective, &observer, monotone, refused_steps_);
    solver.callbacks.push_back(&recorder);
    objective->SetCostLimit(kNoLimit);
    ceres::Solver::Summary summary;
    ceres::Solve(solver, objective->problem(), &summary);
    objective->SetCostLimit(kNoLimit);
    // Where Ceres fails it leaves the point it tried last.
    if (!recorder.records.empty() && !summary.IsSolutionUsable())
      Assign(recorder.kept(), objective->x());

    OptimizerSummary result;
    result.termination = Classify(summary, *objective, recorder);
    result.reason = summary.message;
    if (result.termination == Termination::kStalled)
      result.reason = "The last steps could not be evaluated.";
    else if (recorder.exhausted)
      result.reason = std::to_string(refused_steps_) +
                      " steps in a row did not lower the cost.";
    result.initial_cost = summary.initial_cost;
    result.final_cost = summary.final_cost;
    result.seconds = watch.seconds();
    result.linear_solver_seconds = summary.linear_solver_time_in_seconds;
    result.counts = objective->counts();
    result.iterations = std::move(recorder.records);
    result.details = summary.FullReport();
    return result;
  }

 private:
  ceres::Solver::Options solver_;
  int refused_steps_;
};

}  // namespace

void Describe(OptionTable* table, CeresOptions* o) {
  table->Add(
      "iterations", &o->iterations, {.doc = "most iterations", .at_least = 0});
  table->Add(
      "function_tolerance",
      &o->function_tolerance,
      {.doc = "done when the cost changes by less, relative", .at_least = 0});
  table->Add("parameter_tolerance",
             &o->parameter_tolerance,
             {.doc = "done when the step is smaller, relative", .at_least = 0});
  table->Add(
      "gradient_tolerance",
      &o->gradient_tolerance,
      {.doc = "done when no gradient component is larger", .at_least = 0});
}

void Describe(OptionTable* table, TrustRegionOptions* o) {
  Describe(table, static_cast<CeresOptions*>(o));
  table->Add("refused_steps",
             &o->refused_steps,
             {.doc = "done when so many steps in a row do not lower the cost; "
                     "0: go on",
              .at_least = 0});
  table->Add(
      "radius", &o->radius, {.doc = "first trust region radius", .above = 0});
}

std::unique_ptr<Optimizer> MakeLevenbergMarquardt(
    const TrustRegionOptions& options) {
  ceres::Solver::Options solver;
  solver.initial_trust_region_radius = options.radius;
  return std::make_unique<CeresOptimizer>(
      options, solver, options.refused_steps);
}

std::unique_ptr<Optimizer> MakeDogleg(const TrustRegionOptions& options) {
  ceres::Solver::Options solver;
  solver.initial_trust_region_radius = options.radius;
  solver.trust_region_strategy_type = ceres::DOGLEG;
  solver.dogleg_type = ceres::SUBSPACE_DOGLEG;
  return std::make_unique<CeresOptimizer>(
      options, solver, options.refused_steps);
}

std::unique_ptr<Optimizer> MakeLbfgs(const CeresOptions& options) {
  ceres::Solver::Options solver;
  solver.minimizer_type = ceres::LINE_SEARCH;
  solver.line_search_direction_type = ceres::LBFGS;
  return std::make_unique<CeresOptimizer>(options, solver, 0);
}

}  // namespace invsim
