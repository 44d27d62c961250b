// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_TESTS_FIT_TOY_TERM_H_
#define INVSIM_TESTS_FIT_TOY_TERM_H_

// A data term that is cheap and whose minimum is known: every unknown is
// measured, through a mildly non-linear function. Its body is any.

#include <cmath>
#include <limits>

#include "invsim/fit/data_term.h"
#include "sim/test_scene.h"

namespace invsim {

inline const BodyModel& ToyBody() {
  static const BodyModel body = BallBody();
  return body;
}

class ToyTerm : public DataTerm {
 public:
  explicit ToyTerm(BodySequence truth) : truth_(std::move(truth)) {}

  int num_frames() const override { return truth_.num_frames(); }

  Evaluation Evaluate(const BodySequence& x,
                      double cost_limit,
                      std::vector<double>* costs) override {
    ++evaluations;
    x_ = x;
    if (stopped) return Evaluation::kStopped;
    if (x.translations[0][0] > wall) return Evaluation::kFailed;
    costs->assign(num_frames(), 0);
    double total = 0;
    for (int t = 0; t < num_frames(); ++t)
      total += (*costs)[t] = Frame(t, false).cost;
    return total > cost_limit ? Evaluation::kAbandoned : Evaluation::kDone;
  }

  bool Linearize(std::vector<FrameBlock>* blocks) override {
    blocks->clear();
    if (x_.translations[0][0] > cliff) return false;
    for (int t = 0; t < num_frames(); ++t) blocks->push_back(Frame(t, true));
    return true;
  }

  // Points with a larger x of the first translation cannot be evaluated.
  double wall = std::numeric_limits<double>::infinity();
  // Beyond this there is a cost, but no derivative.
  double cliff = std::numeric_limits<double>::infinity();
  bool stopped = false;  // whether a stop was asked for
  int evaluations = 0;

 private:
  static VectorXd Stack(const BodyParameters& p) {
    VectorXd u(kNumBodyParameters);
    u << p.shape, p.pose, p.translation;
    return u;
  }

  FrameBlock Frame(int t, bool derivatives) const {
    const VectorXd u = Stack(x_.Frame(t)), goal = Stack(truth_.Frame(t));
    BlockCompressor sum(kNumBodyParameters, derivatives);
    for (int i = 0; i < kNumBodyParameters; ++i) {
      VectorXd r(1);
      const double d = u[i] - goal[i];
      r[0] = d + 0.1 * std::sin(d);
      MatrixXd j = MatrixXd::Zero(1, kNumBodyParameters);
      j(0, i) = 1 + 0.1 * std::cos(d);
      sum.Add(r, j, 100, nullptr);
    }
    return sum.Finish();
  }

  BodySequence truth_, x_;
};

}  // namespace invsim

#endif  // INVSIM_TESTS_FIT_TOY_TERM_H_
