// SPDX-License-Identifier: Apache-2.0
#include "loft.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace invsim {
namespace {

// Beyond this distance from its box a solid's distance is that of the box.
constexpr double kFar = 0.1;
// No half axis, carried on into a cap, gets smaller than this.
constexpr double kSmallest = 0.002;

double Power(double x, double n) { return n == 2.0 ? x * x : std::pow(x, n); }

double PowerLessOne(double x, double n) {
  return n == 2.0 ? x : std::pow(x, n - 1.0);
}

double DistanceToBox(const Vector3d& x, const Vector3d& a, const Vector3d& b) {
  return (a - x).cwiseMax(x - b).cwiseMax(0.0).norm();
}

}  // namespace

Loft::Loft(int axis,
           std::vector<Station> stations,
           double cap_low,
           double cap_high)
    : axis_(axis), cap_low_(cap_low), cap_high_(cap_high) {
  const int u_axis = axis == 0 ? 1 : 0;
  const int v_axis = axis == 2 ? 1 : 2;
  low_.setConstant(1e9);
  high_.setConstant(-1e9);
  for (const Station& t : stations) {
    places_.push_back(t.s);
    Channels values;
    values << t.u, t.v, t.u_plus, t.u_minus, t.v_plus, t.v_minus, t.exponent;
    values_.push_back(values);
    low_[u_axis] = std::min(low_[u_axis], t.u - t.u_minus);
    high_[u_axis] = std::max(high_[u_axis], t.u + t.u_plus);
    low_[v_axis] = std::min(low_[v_axis], t.v - t.v_minus);
    high_[v_axis] = std::max(high_[v_axis], t.v + t.v_plus);
  }
  low_[axis] = places_.front() - cap_low;
  high_[axis] = places_.back() + cap_high;
  // Slopes of the parabola through three neighbouring stations.
  const int n = static_cast<int>(places_.size());
  slopes_.resize(n);
  for (int i = 1; i + 1 < n; ++i) {
    const double h0 = places_[i] - places_[i - 1];
    const double h1 = places_[i + 1] - places_[i];
    const Channels below = (values_[i] - values_[i - 1]) / h0;
    const Channels above = (values_[i + 1] - values_[i]) / h1;
    slopes_[i] = (below * h1 + above * h0) / (h0 + h1);
    if (i == 1) slopes_[0] = 2.0 * below - slopes_[1];
    if (i + 2 == n) slopes_[n - 1] = 2.0 * above - slopes_[i];
  }
}

Loft::Channels Loft::At(double s) const {
  const auto next = std::upper_bound(places_.begin(), places_.end(), s);
  if (next == places_.begin() || next == places_.end()) {
    const std::size_t end = next == places_.begin() ? 0 : places_.size() - 1;
    Channels c = values_[end] + slopes_[end] * (s - places_[end]);
    c.segment<4>(2) = c.segment<4>(2).max(kSmallest);
    c[6] = values_[end][6];
    return c;
  }
  const auto i = static_cast<std::size_t>(next - places_.begin()) - 1;
  const double h = places_[i + 1] - places_[i];
  const double t = (s - places_[i]) / h;
  const double r = 1.0 - t;
  return values_[i] * (r * r * (1.0 + 2.0 * t)) +
         values_[i + 1] * (t * t * (1.0 + 2.0 * r)) +
         slopes_[i] * (h * t * r * r) - slopes_[i + 1] * (h * t * t * r);
}

double Loft::Distance(const Vector3d& x) const {
  const double far = DistanceToBox(x, low_, high_);
  if (far > kFar) return far;
  const double s = x[axis_];
  const Channels c =
      At(std::clamp(s, places_.front() - cap_low_, places_.back() + cap_high_));
  const double du = x[axis_ == 0 ? 1 : 0] - c[0];
  const double dv = x[axis_ == 2 ? 1 : 2] - c[1];
  const double ru = du > 0.0 ? c[2] : c[3];
  const double rv = dv > 0.0 ? c[4] : c[5];
  const double n = c[6];
  const double beyond = s < places_.front()  ? (places_.front() - s) / cap_low_
                        : s > places_.back() ? (s - places_.back()) / cap_high_
                                             : 0.0;
  const double cap = s < places_.front() ? cap_low_ : cap_high_;
  const double a = std::abs(du) / ru;
  const double b = std::abs(dv) / rv;
  // r is 1 on the surface; to first order the distance is (r - 1) / |grad r|.
  const double sum = Power(a, n) + Power(b, n) + Power(beyond, n);
  if (sum < 1e-12) return -std::min({c[2], c[3], c[4], c[5]});
  const double r = n == 2.0 ? std::sqrt(sum) : std::pow(sum, 1.0 / n);
  const double scale = r / sum;
  const Vector3d gradient(PowerLessOne(a, n) / ru,
                          PowerLessOne(b, n) / rv,
                          PowerLessOne(beyond, n) / cap);
  return (r - 1.0) / (scale * gradient.norm());
}

double SmoothMin(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - 0.25 * k * h * h;
}

}  // namespace invsim
