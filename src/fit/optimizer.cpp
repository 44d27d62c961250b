// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/optimizer.h"

namespace invsim {

const char* Name(Termination termination) {
  switch (termination) {
    case Termination::kConverged:
      return "converged";
    case Termination::kIterationLimit:
      return "iteration limit";
    case Termination::kTimeLimit:
      return "time limit";
    case Termination::kGivenUp:
      return "given up";
    case Termination::kInterrupted:
      return "interrupted";
    case Termination::kStalled:
      return "stalled";
    case Termination::kFailed:
      return "failed";
  }
  return "";
}

const OptimizerRegistry& Optimizers() {
  static const OptimizerRegistry registry = [] {
    OptimizerRegistry r("optimizer");
    r.Add<TrustRegionOptions>(
        "lm", "Ceres Levenberg-Marquardt", MakeLevenbergMarquardt);
    r.Add<TrustRegionOptions>("dogleg", "Ceres subspace dogleg", MakeDogleg);
    r.Add<CeresOptions>("lbfgs", "Ceres L-BFGS, Wolfe line search", MakeLbfgs);
    r.Add<GradientDescentOptions>("gradient_descent",
                                  "the paper's gradient descent",
                                  MakeGradientDescent);
    return r;
  }();
  return registry;
}

}  // namespace invsim
