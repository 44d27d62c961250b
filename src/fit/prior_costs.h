// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_FIT_PRIOR_COSTS_H_
#define INVSIM_SRC_FIT_PRIOR_COSTS_H_

// The priors of priors.h as Ceres cost functions with analytic derivatives.

#include <ceres/cost_function.h>

#include "invsim/fit/body_overlap.h"
#include "invsim/fit/priors.h"

namespace invsim {

// 72 residuals by theta_{t-1}, theta_t, theta_{t+1}.
ceres::CostFunction* NewRotationSmoothness(double scale);
// 3 residuals by t_{t-1}, t_t, t_{t+1}.
ceres::CostFunction* NewTranslationSmoothness(double scale);
// 10 residuals by beta.
ceres::CostFunction* NewShapePrior(double scale);
// 138 residuals by theta_t.
ceres::CostFunction* NewPosePrior(double scale);
// One residual per pair of `overlap` by beta, theta_t. Both arguments must
// outlive it.
ceres::CostFunction* NewOverlapCost(double scale,
                                    const BodyModel* body,
                                    const BodyOverlap* overlap);

}  // namespace invsim

#endif  // INVSIM_SRC_FIT_PRIOR_COSTS_H_
