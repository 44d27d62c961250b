// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/gradient_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "invsim/base/error.h"
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

}  // namespace

void Describe(OptionTable* table, GradientCheckOptions* o) {
  table->Add(
      "steps", &o->steps, {.doc = "step sizes of the differences", .above = 0});
  table->Add("floor",
             &o->floor,
             {.doc = "share of the body's motion below which a column is "
                     "measured against that share",
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
  run(body.at, &record);
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
  for (int k = 0; k < body.parameters; ++k) {
    const VectorXd column = derivative.x.col(k);
    GradientColumn result;
    result.parameter = k;
    result.norm = column.norm();
    const double floor = options.floor * body_columns.col(k).norm();
    // A parameter that does not move the body cannot move the cloth.
    if (result.norm == 0 && body.moved(k, options.steps[0]) == body.at) {
      ++check.still;
      continue;
    }
    double best = std::numeric_limits<double>::infinity();
    double best_switched = best;
    for (size_t s = 0; s < options.steps.size(); ++s) {
      const double h = options.steps[s];
      FrameRecord plus, minus;
      const VectorXd difference =
          (run(body.moved(k, h), &plus) - run(body.moved(k, -h), &minus)) /
          (2 * h);
      if (difference.norm() == 0 && result.norm == 0) continue;
      const double error =
          (column - difference).norm() /
          std::max(
              {difference.norm(), floor, std::numeric_limits<double>::min()});
      const bool same =
          SameContacts(record, plus) && SameContacts(record, minus);
      errors[s].push_back(error);
      double* least = same ? &best : &best_switched;
      if (error >= *least) continue;
      *least = error;
      if (same || result.switched) {
        result.error = error;
        result.step = h;
      }
      if (same) result.switched = false;
    }
    if (result.norm == 0 && result.step == 0) {
      ++check.still;
      continue;
    }
    check.switched += result.switched;
    double* worst = result.switched ? &check.worst_switched : &check.worst;
    *worst = std::max(*worst, result.error);
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
