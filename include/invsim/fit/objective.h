// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_FIT_OBJECTIVE_H_
#define INVSIM_FIT_OBJECTIVE_H_

// The whole least-squares problem: data term and priors over the unknowns of a
// sequence, as a ceres::Problem.
//
//   parameter blocks   beta[10]; theta_t[72], t_t[3] for every frame
//   residual blocks    per frame the compressed data block (frame_block.h)
//                      and the pose prior; per three frames the second
//                      differences; once the shape prior; per frame the
//                      overlap of body parts, if it has a weight
//
// The data term is evaluated once per point for all frames (Ceres's
// EvaluationCallback); the blocks only read what it left.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "invsim/fit/data_term.h"
#include "invsim/fit/priors.h"

namespace ceres {
class Problem;
}

namespace invsim {

// Which unknowns may move.
struct FreeParameters {
  bool shape = true;
  bool translation = true;
  std::vector<bool> joints = std::vector<bool>(kNumJoints, true);
};

struct ObjectiveCounts {
  int evaluations = 0;     // of the data term, all outcomes
  int linearizations = 0;  // of the data term
  int abandoned = 0;       // evaluations that were given up as worse
  int failed = 0;          // evaluations that were impossible
  int no_derivative = 0;   // of these: there was a cost, but no derivative

  void Add(const ObjectiveCounts& other);
};

struct CostTerms {
  double data = 0;
  double smoothness = 0;
  double shape = 0;
  double pose = 0;
  double overlap = 0;
  double total() const { return data + smoothness + shape + pose + overlap; }
};

class Objective {
 public:
  // `data` (null: priors alone), `x` and `body` must outlive the objective;
  // optimisers change `x`
  // in place. `body` is what `x` poses: its parts may overlap.
  Objective(const PriorOptions& priors,
            const FreeParameters& free,
            DataTerm* data,
            BodySequence* x,
            const BodyModel& body);
  ~Objective();

  // What is known before any point is measured, at the same x.
  std::unique_ptr<Objective> WithoutData() const;

  ceres::Problem* problem();
  BodySequence* x();

  // Evaluations may be given up above this cost; infinity: never.
  void SetCostLimit(double limit);

  // The parameter blocks that may move: beta, then theta_t, t_t by frame.
  const std::vector<double*>& blocks() const;

  // Cost, and the gradient by `blocks()` (in the tangent space of a block that
  // is partly fixed) unless null, at x. False if it cannot be evaluated there.
  bool Evaluate(double* cost, std::vector<double>* gradient);

  // The terms at the point evaluated last.
  CostTerms terms() const;
  const ObjectiveCounts& counts() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace invsim

#endif  // INVSIM_FIT_OBJECTIVE_H_
