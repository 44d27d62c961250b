// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/optimizer_comparison.h"

#include <algorithm>
#include <cmath>

#include "invsim/base/interrupt.h"

namespace invsim {
namespace {

double Measure(const ComparisonPoint& point) {
  return std::isnan(point.body_error) ? point.cost : point.body_error;
}

// Finds what all runs begin with, however long that takes.
FitResult FindCommonStart(FitScene* scene,
                          FitOptions* options,
                          const FitObserver& observer) {
  const double limit = options->time_limit;
  options->time_limit = 0;
  scene->optimize = false;
  FitObserver watching;
  watching.init = observer.init;
  watching.relaxation = observer.relaxation;
  FitResult found = FitSequence(*scene, *options, watching);
  options->time_limit = limit;
  scene->optimize = true;
  scene->start = found.start;
  if (found.reference()) scene->reference = *found.reference();
  return found;
}

// The runs that there would have been.
std::vector<ComparisonRun> NoneStarted(const std::vector<std::string>& names,
                                       const std::string& reason) {
  std::vector<ComparisonRun> runs;
  for (const std::string& name : names) {
    runs.emplace_back().optimizer = name;
    runs.back().summary.reason = reason;
  }
  return runs;
}

}  // namespace

double BodyError(const BodyModel& model,
                 const BodySequence& a,
                 const BodySequence& b) {
  double sum = 0;
  const int frames = std::min(a.num_frames(), b.num_frames());
  for (int t = 0; t < frames; ++t)
    sum += (model.Vertices(a.Frame(t)) - model.Vertices(b.Frame(t)))
               .colwise()
               .norm()
               .mean();
  return sum / frames;
}

std::vector<ComparisonRun> CompareOptimizers(
    FitScene scene,
    FitOptions* options,
    const std::vector<std::string>& names,
    const std::optional<BodySequence>& truth,
    const FitObserver& observer,
    const std::function<void(const std::string& name)>& begin) {
  std::vector<ComparisonRun> runs;
  for (const std::string& name : names)
    if (options->optimizers.count(name) == 0) Optimizers().Choose(name);
  const FitResult common = FindCommonStart(&scene, options, observer);
  if (InterruptRequested()) return runs;
  if (!common.reference()) return NoneStarted(names, common.reason);
  for (const std::string& name : names) {
    if (begin) begin(name);
    ComparisonRun run;
    run.optimizer = options->optimizer = name;
    FitObserver watching = observer;
    watching.iteration = [&](const FitIteration& i) {
      ComparisonPoint point{
          i.record.iteration, i.steps, i.record.seconds, i.record.cost};
      if (truth) point.body_error = BodyError(scene.body, i.body, *truth);
      run.points.push_back(point);
      return !observer.iteration || observer.iteration(i);
    };
    const FitResult result = FitSequence(scene, *options, watching);
    if (result.optimizer()) run.summary = *result.optimizer();
    if (result.termination == Termination::kTimeLimit) {
      run.summary.termination = result.termination;
      run.summary.reason = result.reason;
    }
    runs.push_back(std::move(run));
    if (InterruptRequested()) break;
  }
  return runs;
}

double Best(const ComparisonRun& run) {
  double best = std::numeric_limits<double>::infinity();
  for (const ComparisonPoint& point : run.points)
    best = std::min(best, Measure(point));
  return best;
}

std::optional<long> StepsToReach(const ComparisonRun& run, double wanted) {
  for (const ComparisonPoint& point : run.points)
    if (Measure(point) <= wanted) return point.steps;
  return std::nullopt;
}

}  // namespace invsim
