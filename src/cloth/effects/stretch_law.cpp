// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/effects/stretch_law.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace invsim {
namespace {

using Constants = StretchLaw::Constants;

constexpr int kSamplesPerAxis = 30;          // grid points per axis
constexpr double kPerStrain = 30.0;          // grid points per unit of strain
constexpr double kLowest = -0.25;            // first E11 and E22
constexpr double kMeasuredStretch = 1 / 6.;  // stretch of rows 1 to 5

// The constants of a measured fabric at one strain, by the definition.
Constants Evaluate(const MeasuredStretch& fabric,
                   double e11,
                   double e22,
                   double e12) {
  const double mean = 1.0 + e11 + e22;
  const double half = e11 - e22;
  const double radius = std::hypot(half, 2.0 * e12);
  const double stretch = std::sqrt(mean + radius);
  // Direction of the larger stretch; axis 1 where there is none.
  const double angle = 0.5 * std::atan2(2.0 * e12, half);

  const double weight =
      std::clamp((stretch - 1.0) / kMeasuredStretch, 0.0, 1.0);
  const double direction = angle * 8.0 / std::numbers::pi;  // 0 to 4
  const int lower = std::clamp(static_cast<int>(direction), 0, 3);
  const double part = direction - lower;

  Constants c;
  for (int k = 0; k < 4; ++k) {
    const double measured = (1.0 - part) * fabric.table[1 + lower][k] +
                            part * fabric.table[2 + lower][k];
    c[k] =
        std::max(0.0, (1.0 - weight) * fabric.table[0][k] + weight * measured);
  }
  c.head<3>() *= 2.0;
  c[1] = std::min(c[1], std::sqrt(c[0] * c[2]));
  return c;
}

std::vector<Constants> Sample(const MeasuredStretch& fabric) {
  std::vector<Constants> samples;
  samples.reserve(kSamplesPerAxis * kSamplesPerAxis * kSamplesPerAxis);
  for (int i = 0; i < kSamplesPerAxis; ++i)
    for (int j = 0; j < kSamplesPerAxis; ++j)
      for (int k = 0; k < kSamplesPerAxis; ++k)
        samples.push_back(Evaluate(fabric,
                                   kLowest + i / kPerStrain,
                                   kLowest + j / kPerStrain,
                                   k / kPerStrain));
  return samples;
}

// Where a strain lies on one axis of the grid.
struct Cell {
  int index;
  double part;   // 0 to 1 within the cell
  double slope;  // d(part)/d(strain); zero beyond the grid
};

Cell Locate(double strain, double lowest) {
  const double at = (strain - lowest) * kPerStrain;
  if (!(at > 0.0)) return {0, 0.0, 0.0};
  if (at >= kSamplesPerAxis - 1) return {kSamplesPerAxis - 2, 1.0, 0.0};
  const int index = static_cast<int>(at);
  return {index, at - index, kPerStrain};
}

}  // namespace

StretchLaw::StretchLaw(const StretchModel& model) {
  if (const auto* iso = std::get_if<IsotropicStretch>(&model)) {
    const double nu = iso->poisson;
    const double c = iso->stiffness / (1.0 - nu * nu);
    constants_ << c, nu * c, c, 0.5 * (1.0 - nu) * c;
  } else if (const auto* ortho = std::get_if<OrthotropicStretch>(&model)) {
    constants_ << ortho->c11, ortho->c12, ortho->c22, ortho->c33;
  } else {
    samples_ = Sample(std::get<MeasuredStretch>(model));
  }
}

StretchLaw::Constants StretchLaw::Interpolate(
    const Vector3d& strain, ConstantsGradient* gradient) const {
  const double e12 = 0.5 * strain[2];
  const Cell a = Locate(strain[0], kLowest);
  const Cell b = Locate(strain[1], kLowest);
  const Cell c = Locate(std::abs(e12), 0.0);

  // Interpolate along axis 3, then 2, then 1, keeping the differences.
  Constants value[2], d3[2], d2[2];
  for (int i = 0; i < 2; ++i) {
    Constants row[2], row_d3[2];
    for (int j = 0; j < 2; ++j) {
      const Constants* s =
          &samples_[((a.index + i) * kSamplesPerAxis + b.index + j) *
                        kSamplesPerAxis +
                    c.index];
      row_d3[j] = s[1] - s[0];
      row[j] = s[0] + c.part * row_d3[j];
    }
    d2[i] = row[1] - row[0];
    value[i] = row[0] + b.part * d2[i];
    d3[i] = row_d3[0] + b.part * (row_d3[1] - row_d3[0]);
  }
  const Constants d1 = value[1] - value[0];
  if (gradient) {
    gradient->col(0) = a.slope * d1;
    gradient->col(1) = b.slope * (d2[0] + a.part * (d2[1] - d2[0]));
    // |E12| by 2 E12: half, with the sign of E12 (that of + at zero).
    const double sign = std::copysign(0.5, e12);
    gradient->col(2) = sign * c.slope * (d3[0] + a.part * (d3[1] - d3[0]));
  }
  return value[0] + a.part * d1;
}

}  // namespace invsim
