// SPDX-License-Identifier: Apache-2.0
#include "settling.h"

#include <cmath>
#include <limits>

namespace invsim {
namespace {

// Modes rest if in each of so many iterations at most this share changed.
constexpr int kResting = 3;
constexpr double kChanging = 0.01;
// Iterations over which the rate is taken: the residual does not fall evenly.
constexpr size_t kWindow = 8;

}  // namespace

void Settling::Add(double residual, const std::vector<ContactMode>& modes) {
  log_residual_.push_back(std::log(residual));
  size_t changed = modes.size();
  if (modes_.size() == modes.size()) {
    changed = 0;
    for (size_t k = 0; k < modes.size(); ++k) changed += modes[k] != modes_[k];
  }
  resting_ = changed <= kChanging * modes.size() ? resting_ + 1 : 0;
  modes_ = modes;
}

bool Settling::ModesRest() const {
  return resting_ >= kResting && log_residual_.size() > kWindow;
}

double Settling::IterationsLeft(double tolerance) const {
  const size_t n = log_residual_.size();
  const double never = std::numeric_limits<double>::infinity();
  if (n <= kWindow) return never;
  const double left = log_residual_[n - 1] - std::log(tolerance);
  const double fall =
      (log_residual_[n - 1 - kWindow] - log_residual_[n - 1]) / kWindow;
  if (left <= 0) return 0;
  return fall > 0 ? left / fall : never;
}

}  // namespace invsim
