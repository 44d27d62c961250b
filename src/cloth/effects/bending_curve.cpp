// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/effects/bending_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace invsim {
namespace {

constexpr double kCurvatureStep = 10.0;  // 1/m between columns of the table

// Table row of an edge direction: 0 along axis 1, 1 at 45, 2 at 90 degrees.
double TableRow(const Vector2d& direction) {
  const double angle =
      std::atan2(std::abs(direction.y()), std::abs(direction.x()));
  return std::min(angle * 4.0 / std::numbers::pi, 2.0);
}

std::array<double, 5> MeasuredNodes(const MeasuredBending& fabric,
                                    const HingeRest& rest) {
  std::array<double, 5> nodes;
  nodes.fill(std::numeric_limits<double>::infinity());
  for (const Vector2d& direction : rest.directions) {
    const double row = TableRow(direction);
    const int lower = row < 1.0 ? 0 : 1;
    const double part = row - lower;
    for (int k = 0; k < 5; ++k) {
      const double value = (1.0 - part) * fabric.table[lower][k] +
                           part * fabric.table[lower + 1][k];
      nodes[k] = std::min(nodes[k], std::max(value, 0.0));
    }
  }
  return nodes;
}

}  // namespace

BendingCurve::Value BendingCurve::At(double bend) const {
  const double at = std::abs(bend) * per_radian_;
  if (!(at < 4.0)) return {nodes_[4], 0.0};  // also if not a number
  const int lower = static_cast<int>(at);
  const double rise = nodes_[lower + 1] - nodes_[lower];
  return {nodes_[lower] + (at - lower) * rise,
          (bend < 0.0 ? -rise : rise) * per_radian_};
}

double BendingCurve::Energy(double bend) const {
  // In units of nodes: integral of k(s) s over each stretch between nodes,
  // where k = a + b s.
  const double at = std::abs(bend) * per_radian_;
  double sum = 0.0;
  for (int i = 0; i < 4 && i < at; ++i) {
    const double from = i;
    const double to = std::min(at, i + 1.0);
    const double b = nodes_[i + 1] - nodes_[i];
    const double a = nodes_[i] - b * i;
    sum += a * (to * to - from * from) / 2.0 +
           b * (to * to * to - from * from * from) / 3.0;
  }
  if (at > 4.0) sum += nodes_[4] * (at * at - 16.0) / 2.0;
  return sum / (per_radian_ * per_radian_);
}

BendingCurve MakeBendingCurve(const BendingModel& model,
                              const HingeRest& rest) {
  const double shape = rest.length * rest.length / rest.area;
  const double step = kCurvatureStep * rest.area / rest.length;
  std::array<double, 5> nodes;
  if (const auto* iso = std::get_if<IsotropicBending>(&model)) {
    nodes.fill(iso->stiffness * shape);
  } else {
    nodes = MeasuredNodes(std::get<MeasuredBending>(model), rest);
    for (double& k : nodes) k *= shape / 4.0;
  }
  return BendingCurve(nodes, step);
}

}  // namespace invsim
