// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_FIT_OPTIMIZER_H_
#define INVSIM_FIT_OPTIMIZER_H_

// Optimisers of an Objective, behind one interface and with one summary:
//
//   lm                Ceres's Levenberg-Marquardt
//   dogleg            Ceres's subspace dogleg
//   lbfgs             Ceres's limited-memory BFGS with Wolfe line search
//   gradient_descent  the paper's: x <- x - step * gradient, with a fixed
//                     step or one found by backtracking (Armijo)

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "invsim/base/registry.h"
#include "invsim/fit/objective.h"

namespace invsim {

enum class Termination {
  kConverged,       // a tolerance was met
  kIterationLimit,  // usable, not converged
  kTimeLimit,       // likewise; said by who watches the time (sequence_fit.h)
  kGivenUp,         // likewise; of a round without prospects (sequence_fit.h)
  kInterrupted,     // the observer asked for a stop
  kStalled,         // the last steps failed to evaluate: at the border of what
                    // can be simulated
  kFailed           // the start cannot be evaluated, or nothing was gained
};
const char* Name(Termination termination);

struct IterationRecord {
  int iteration = 0;
  double cost = 0;  // of the point kept
  bool successful = true;
  double gradient_norm = 0;  // largest component
  double step_norm = 0;
  double seconds = 0;  // since the start
  ObjectiveCounts counts;
  CostTerms terms;  // filled for successful iterations
};

struct OptimizerSummary {
  Termination termination = Termination::kFailed;
  std::string reason;  // one sentence
  double initial_cost = 0;
  double final_cost = 0;
  double seconds = 0;
  double linear_solver_seconds = 0;  // of these, for the steps
  ObjectiveCounts counts;
  std::vector<IterationRecord> iterations;
  std::string details;  // the solver's own full report, or empty

  bool usable() const { return termination != Termination::kFailed; }
  // The first record is of the start.
  int num_iterations() const {
    return iterations.empty() ? 0 : static_cast<int>(iterations.size()) - 1;
  }
};

// Called after every iteration, with the point kept in objective->x(). A false
// answer asks to stop.
using IterationObserver = std::function<bool(const IterationRecord&)>;

class Optimizer {
 public:
  virtual ~Optimizer() = default;
  // Changes objective->x() to the best point found.
  virtual OptimizerSummary Run(Objective* objective,
                               const IterationObserver& observer) const = 0;
  // Whether the steps after the first are, all in all, not expected to gain
  // more than it did, as with Newton's methods (docs/accuracy.md).
  virtual bool first_step_gains_most() const { return false; }
};

// What all of Ceres's optimisers have; L-BFGS has no more.
struct CeresOptions {
  int iterations = 30;
  double function_tolerance = 1e-4;   // |change of cost| / cost
  double parameter_tolerance = 1e-8;  // |step| / |x|
  double gradient_tolerance = 1e-10;  // largest component
};
void Describe(OptionTable* table, CeresOptions* options);

struct TrustRegionOptions : CeresOptions {
  // Nearest points and contacts make the cost rough on a small scale, on which
  // no step helps and each costs a whole simulation.
  int refused_steps = 5;
  double radius = 1e4;  // first trust region
};
void Describe(OptionTable* table, TrustRegionOptions* options);

struct GradientDescentOptions {
  int iterations = 300;
  // Paper: one small fixed step. Backtracking starts from it, doubles it after
  // a step taken at once and halves it until the cost falls enough.
  double step = 1e-7;
  bool backtracking = true;
  double function_tolerance = 1e-6;
};
void Describe(OptionTable* table, GradientDescentOptions* options);

std::unique_ptr<Optimizer> MakeLevenbergMarquardt(
    const TrustRegionOptions& options);
std::unique_ptr<Optimizer> MakeDogleg(const TrustRegionOptions& options);
std::unique_ptr<Optimizer> MakeLbfgs(const CeresOptions& options);
std::unique_ptr<Optimizer> MakeGradientDescent(
    const GradientDescentOptions& options);

using OptimizerRegistry = Registry<Optimizer>;
const OptimizerRegistry& Optimizers();

}  // namespace invsim

#endif  // INVSIM_FIT_OPTIMIZER_H_
