// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_STUDY_GRADIENT_CHECK_H_
#define INVSIM_STUDY_GRADIENT_CHECK_H_

// Holds the derivative of a frame, d(cloth at its end)/d(beta, theta_t, t_t),
// against central differences of the simulation, column by column.
//
// The frame is piecewise smooth: where a contact opens, sticks, slides or
// changes its face between the two simulations of a difference, the difference
// straddles two pieces and says nothing about the derivative of either. Both
// are reported: the error of columns whose contacts stayed as they were, which
// must be small, and the share and size of the others. Per column the step is
// swept and the best agreement kept (the minimum of the V-shaped error curve:
// truncation at large steps, rounding at small ones).

#include <vector>

#include "invsim/body/body_model.h"
#include "invsim/sim/simulator.h"

namespace invsim {

struct GradientCheckOptions {
  std::vector<double> steps = {1e-4, 1e-5, 1e-6, 1e-7, 1e-8};
};
void Describe(OptionTable* table, GradientCheckOptions* options);

struct GradientColumn {
  int parameter = 0;     // 0-9 beta, 10-81 theta, 82-84 t
  double norm = 0;       // of the analytic column, over all vertices
  double error = 0;      // |analytic - difference| / |difference|, best step
  double step = 0;       // at which it was reached
  bool switched = true;  // contacts changed at every step tried
};

struct GradientCheck {
  std::vector<GradientColumn> columns;  // of parameters that move the cloth
  int still = 0;              // parameters without influence, exactly zero
  int switched = 0;           // columns in which contacts changed
  double worst = 0;           // error of the columns in which they did not
  double worst_switched = 0;  // of those in which they did
  // Per step size: the median error over all columns that were compared.
  std::vector<double> steps, median_error;
};

// Simulates the frame in which the body moves from `previous` to `parameters`
// and the cloth starts at `start`, and checks its derivative. `simulator` must
// be solved tightly (friction tolerance near 1e-10) for small differences to
// mean anything. Throws InputError if the frame cannot be simulated.
GradientCheck CheckFrameGradient(const GradientCheckOptions& options,
                                 const BodyModel& body,
                                 const Points& previous,
                                 const BodyParameters& parameters,
                                 double duration,
                                 const ClothState& start,
                                 Simulator* simulator);

}  // namespace invsim

#endif  // INVSIM_STUDY_GRADIENT_CHECK_H_
