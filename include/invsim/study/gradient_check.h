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
// truncation at large steps, rounding at small ones), among the differences
// and what two neighbouring ones extrapolate to.

#include <functional>
#include <vector>

#include "invsim/body/body_model.h"
#include "invsim/sim/simulator.h"

namespace invsim {

struct GradientCheckOptions {
  std::vector<double> steps = {1e-4, 1e-5, 1e-6, 1e-7, 1e-8};
  // A column smaller than this share of the body's own (over the vertices in
  // contact) is measured against that share: of cloth that slides, or that the
  // body hardly touches, nothing but rounding is left to compare. 0: every
  // column against itself.
  double floor = 0;
  // How far the solver leaves a position open, m: a difference over a step h
  // below sqrt(rows) noise / h may be none. Of a column that is below that even
  // at the longest step (no contact acts, or on vertices that the parameter
  // hardly moves) only differences above it are compared. Such a difference may
  // confirm a column, but refutes none: if column and difference are below it
  // at all steps over which contacts stay, the column counts as switched. So it
  // does where differences grow like 1 / h far above it, as the frame jumps
  // from one solution to another.
  double noise = 0;
};
void Describe(OptionTable* table, GradientCheckOptions* options);

struct GradientColumn {
  int parameter = 0;     // of a BodyModel: 0-9 beta, 10-81 theta, 82-84 t
  double norm = 0;       // of the analytic column, over all vertices
  double error = 0;      // |analytic - difference| / |difference|, best step
  double step = 0;       // at which it was reached
  bool switched = true;  // contacts changed at every step tried
};

struct GradientCheck {
  std::vector<GradientColumn> columns;  // of parameters that move the cloth
  int still = 0;              // parameters without influence to speak of
  int switched = 0;           // columns in which contacts changed
  double worst = 0;           // error of the columns in which they did not
  double worst_switched = 0;  // of those in which they did
  // Per step size: the median error over all columns that were compared.
  std::vector<double> steps, median_error;

  // Columns whose contacts stay as they are: the ones that tell something.
  int compared() const { return static_cast<int>(columns.size()) - switched; }
};

// A body at the end of a frame and the numbers that move it there.
struct MovableBody {
  Points at;           // 3 x V
  int parameters = 0;  // p
  // The body with one of them changed by `step`.
  std::function<Points(int parameter, double step)> moved;
  // d(listed vertices)/d(parameters), 3 rows per entry, p columns.
  std::function<Columns(const std::vector<int>& vertices)> jacobian;
};

// Simulates the frame in which the body moves from `previous` to `body.at`
// and the cloth starts at `start`, and checks its derivative. `simulator` must
// be solved tightly (friction tolerance near 1e-10) for small differences to
// mean anything. An interrupt leaves out what is not yet compared. Throws
// InputError if the frame cannot be simulated.
GradientCheck CheckFrameGradient(const GradientCheckOptions& options,
                                 const MovableBody& body,
                                 const Points& previous,
                                 double duration,
                                 const ClothState& start,
                                 Simulator* simulator);

// The same with beta, theta and t as the parameters.
GradientCheck CheckFrameGradient(const GradientCheckOptions& options,
                                 const BodyModel& body,
                                 const Points& previous,
                                 const BodyParameters& parameters,
                                 double duration,
                                 const ClothState& start,
                                 Simulator* simulator);

}  // namespace invsim

#endif  // INVSIM_STUDY_GRADIENT_CHECK_H_
