// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/gradient_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "invsim/base/error.h"
#include "invsim/base/interrupt.h"
#include "invsim/base/options.h"
#include "invsim/sim/sensitivity.h"

namespace invsim {
namespace {

BodyParameters Moved(BodyParameters p, int parameter, double step) {
  if (parameter < kNumShape)
    p.shape[parameter] += step;
  else if (parameter < kNumShape + kNumPose)
    p.pose[parameter - kNumShape] += step;
  else
    p.translation[parameter - kNumShape - kNumPose] += step;
  return p;
}

double Median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The larger of the two; what is not a number stays.
void Raise(double error, double* worst) {
  if (!std::isnan(*worst) && !(error <= *worst)) *worst = error;
}

// Where the two simulations of a difference end as far from each other over a
// tenth of the step, and that is so many times what the solver leaves open, the
// frame has two solutions (friction may have several) and neither is the
// other's neighbour.
constexpr double kJump = 100;

// A central difference of the cloth, and whether its two simulations met the
// contacts of the frame.
struct Difference {
  VectorXd value;
  bool same = false;
  // How far the frame lies off the middle between the two, by the step. If
  // that does not vanish the frame has another solution than its neighbours.
  double bend = 0;
};

// The difference for a step towards zero, from one at a step `ratio` times the
// other's (Richardson): its truncation is of fourth order.
Difference Extrapolated(const Difference& coarse,
                        const Difference& fine,
                        double ratio) {
  const double square = ratio * ratio;
  return {(square * fine.value - coarse.value) / (square - 1),
          coarse.same && fine.same,
          fine.bend};
}

// Holds one column against differences and keeps the best agreement, that of
// unchanged contacts before all others.
class ColumnCheck {
 public:
  // `still`: measured against that if the difference is less.
  ColumnCheck(const GradientCheckOptions& options,
              int parameter,
              const VectorXd& column,
              double still)
      : column_(column), still_(still), noise_(options.noise) {
    result_.parameter = parameter;
    result_.norm = column.norm();
    faint_ = result_.norm <= Noise(*std::max_element(options.steps.begin(),
                                                     options.steps.end()));
  }

  // The differences come from the longest step to the shortest. What a column
  // is off by one, unless the two are lost in what the solver leaves open.
  std::optional<double> Add(Difference d, double step) {
    const double moved = d.value.norm(), noise = Noise(step);
    if (faint_ && moved <= noise) return std::nullopt;
    const bool vanishes = std::max(result_.norm, moved) <= noise;
    tells_ = tells_ || (d.same && !vanishes);
    const double error = Compare(d, step);
    if (compared()) {
      Compare(Extrapolated(last_, d, last_step_ / step), step);
      jumps_ = d.bend > kJump * noise ||
               (moved > kJump * noise &&
                step * moved > 0.5 * last_step_ * last_.value.norm());
    }
    last_ = std::move(d);
    last_step_ = step;
    return error;
  }

  bool compared() const { return last_step_ > 0; }

  GradientColumn result() const {
    GradientColumn result = result_;
    // Whatever was compared straddles two pieces.
    if (!tells_ || (jumps_ && noise_ > 0)) result.switched = true;
    return result;
  }

 private:
  // Of a difference, what the solver leaves open.
  double Noise(double step) const {
    return noise_ / step * std::sqrt(static_cast<double>(column_.size()));
  }

  double Compare(const Difference& d, double step) {
    const double error =
        (column_ - d.value).norm() /
        std::max({d.value.norm(), still_, std::numeric_limits<double>::min()});
    double* least = d.same ? &best_ : &best_switched_;
    if (error >= *least) return error;
    *least = error;
    if (d.same || result_.switched) {
      result_.error = error;
      result_.step = step;
    }
    if (d.same) result_.switched = false;
    return error;
  }

  VectorXd column_;
  double still_, noise_;
  bool faint_ = false;  // compared are only differences that tell something
  bool tells_ = false, jumps_ = false;
  Difference last_;
  double last_step_ = 0;  // 0: nothing compared yet
  GradientColumn result_;
  double best_ = std::numeric_limits<double>::infinity();
  double best_switched_ = std::numeric_limits<double>::infinity();
};

}  // namespace

void Describe(OptionTable* table, GradientCheckOptions* o) {
  table->Add(
      "steps", &o->steps, {.doc = "step sizes of the differences", .above = 0});
  table->Add("floor",
             &o->floor,
             {.doc = "share of the body's motion below which a column is "
                     "measured against that share",
              .at_least = 0});
  table->Add("noise",
             &o->noise,
             {.doc = "how far the solver leaves a position open",
              .unit = "m",
              .at_least = 0});
}

GradientCheck CheckFrameGradient(const GradientCheckOptions& options,
                                 const MovableBody& body,
                                 const Points& previous,
                                 double duration,
                                 const ClothState& start,
                                 Simulator* simulator) {
  const auto run = [&](const Points& at, FrameRecord* record) {
    ClothState state = start;
    StepStats stats;
    if (!simulator->Advance(previous, at, duration, &state, &stats, record))
      throw InputError(
          "check-gradient: the frame cannot be simulated: its "
          "result is not finite");
    return VectorXd(Stacked(state.x));
  };
  FrameRecord record;
  const VectorXd middle = run(body.at, &record);
  const auto differ = [&](int k, double h) {
    FrameRecord plus, minus;
    const VectorXd high = run(body.moved(k, h), &plus);
    const VectorXd low = run(body.moved(k, -h), &minus);
    return Difference{(high - low) / (2 * h),
                      SameContacts(record, plus) && SameContacts(record, minus),
                      (high + low - 2 * middle).norm() / (2 * h)};
  };
  const std::vector<int> vertices =
      Sensitivity::BodyVertices(simulator->body_faces(), record);
  const Columns body_columns = body.jacobian(vertices);
  Sensitivity sensitivity(*simulator);
  StateColumns derivative;
  if (!sensitivity.Forward(
          record, vertices, Columns(), body_columns, nullptr, &derivative))
    throw InputError("check-gradient: the derivative of the frame is singular");

  GradientCheck check;
  check.steps = options.steps;
  std::vector<std::vector<double>> errors(options.steps.size());
  for (int k = 0; k < body.parameters && !InterruptRequested(); ++k) {
    // A parameter that does not move the body cannot move the cloth.
    if (derivative.x.col(k).norm() == 0 &&
        body.moved(k, options.steps[0]) == body.at) {
      ++check.still;
      continue;
    }
    ColumnCheck column(options,
                       k,
                       derivative.x.col(k),
                       options.floor * body_columns.col(k).norm());
    for (size_t s = 0; s < options.steps.size(); ++s) {
      const double h = options.steps[s];
      if (const std::optional<double> error = column.Add(differ(k, h), h))
        errors[s].push_back(*error);
    }
    if (!column.compared()) {
      ++check.still;
      continue;
    }
    const GradientColumn result = column.result();
    check.switched += result.switched;
    Raise(result.error, result.switched ? &check.worst_switched : &check.worst);
    check.columns.push_back(result);
  }
  for (const std::vector<double>& e : errors)
    check.median_error.push_back(Median(e));
  return check;
}

GradientCheck CheckFrameGradient(const GradientCheckOptions& options,
                                 const BodyModel& body,
                                 const Points& previous,
                                 const BodyParameters& parameters,
                                 double duration,
                                 const ClothState& start,
                                 Simulator* simulator) {
  MovableBody movable;
  movable.at = body.Vertices(parameters);
  movable.parameters = kNumBodyParameters;
  movable.moved = [&](int parameter, double step) {
    return body.Vertices(Moved(parameters, parameter, step));
  };
  movable.jacobian = [&](const std::vector<int>& vertices) {
    return Columns(body.Pose(parameters)->Jacobian(vertices));
  };
  return CheckFrameGradient(
      options, movable, previous, duration, start, simulator);
}

}  // namespace invsim
