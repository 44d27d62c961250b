// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_FIT_LOSS_H_
#define INVSIM_FIT_LOSS_H_

// Robust losses by name and scale. A residual r of one measured point costs
//
//   1/2 rho(s),  s = |r|^2,
//
// with Ceres's loss functions (ceres/loss_function.h); a = scale, in the unit
// of r (the fit's residuals are metres):
//
//   trivial    s
//   huber      s up to a^2, then 2 a sqrt(s) - a^2
//   soft_l1    2 a^2 (sqrt(1 + s / a^2) - 1)
//   cauchy     a^2 log(1 + s / a^2)
//   arctan     a^2 atan(s / a^2)
//   tukey      a^2 / 3 (1 - (1 - s / a^2)^3), constant beyond a^2
//   tolerant   b log(1 + exp((s - a^2) / b)) less its value at 0, b = a^2 / 4:
//              nearly nothing up to a, then s
//
// All but trivial and tolerant grow more slowly than s, so that one far point
// cannot decide the fit.

#include <memory>
#include <string>

#include "invsim/base/registry.h"

namespace ceres {
class LossFunction;
}

namespace invsim {

struct LossScale {
  double scale = 0.02;  // metres
};
void Describe(OptionTable* table, LossScale* options);

using LossRegistry = Registry<ceres::LossFunction>;
const LossRegistry& Losses();

// A loss as it is asked for in options.
struct LossOptions {
  std::string name = "cauchy";
  double scale = 0.02;  // metres
};
void Describe(OptionTable* table, LossOptions* options);

// Throws UsageError for an unknown name (with the nearest known one) or a
// scale that is not positive.
std::shared_ptr<const ceres::LossFunction> MakeLoss(const LossOptions& options);

}  // namespace invsim

#endif  // INVSIM_FIT_LOSS_H_
