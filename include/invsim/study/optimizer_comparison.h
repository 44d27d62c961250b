// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_STUDY_OPTIMIZER_COMPARISON_H_
#define INVSIM_STUDY_OPTIMIZER_COMPARISON_H_

// The same fit, from the same start, by several optimisers: how cost and error
// of the body fall with simulation steps and with time. Steps are what carries
// over to other machines.

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "invsim/fit/sequence_fit.h"

namespace invsim {

struct ComparisonPoint {
  int iteration = 0;
  long steps = 0;      // of simulation
  double seconds = 0;  // of the optimisation
  double cost = 0;
  // Mean distance of body vertices from the truth, m; NaN if it is not known.
  double body_error = std::numeric_limits<double>::quiet_NaN();
};

struct ComparisonRun {
  std::string optimizer;
  OptimizerSummary summary;
  std::vector<ComparisonPoint> points;  // one per iteration, the start first
};

// Mean over frames and vertices of |M(a) - M(b)|, m.
double BodyError(const BodyModel& model,
                 const BodySequence& a,
                 const BodySequence& b);

// Runs the optimisers in the order of `names` (names of Optimizers(); throws
// UsageError for another). The start is found once before, and so is the cloth
// at rest on it: options->time_limit is for each run from there on. For all to
// go the same way options->dressings is 1. `observer.iteration` is told of
// each, `begin` of each optimiser before it. Where nothing can be worn all have
// failed. Ends after the run in which a stop was asked for.
std::vector<ComparisonRun> CompareOptimizers(
    FitScene scene,
    FitOptions* options,
    const std::vector<std::string>& names,
    const std::optional<BodySequence>& truth,
    const FitObserver& observer,
    const std::function<void(const std::string& name)>& begin);

// The least steps after which `run` has a body error (or, where that is not
// known, a cost) of at most `wanted`; nothing if it never has.
std::optional<long> StepsToReach(const ComparisonRun& run, double wanted);

// The best body error (or cost) of a run.
double Best(const ComparisonRun& run);

}  // namespace invsim

#endif  // INVSIM_STUDY_OPTIMIZER_COMPARISON_H_
