// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/section_tube.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "invsim/base/error.h"

namespace invsim {
namespace {
constexpr double kNothing = -std::numeric_limits<double>::infinity();
}  // namespace

SectionTube::SectionTube(const Points& vertices,
                         const Faces& faces,
                         const std::vector<char>& chosen,
                         const Vector3d& start,
                         const Vector3d& end,
                         double spacing)
    : start_(start),
      axis_((end - start).normalized()),
      u_(axis_.unitOrthogonal()),
      v_(axis_.cross(u_)),
      length_((end - start).norm()),
      spacing_(spacing) {
  for (int k = 0; k < kDirections; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kDirections;
    cosine_[k] = std::cos(angle);
    sine_[k] = std::sin(angle);
  }
  const int sections = static_cast<int>(length_ / spacing_) + 2;
  reach_ = MatrixXd::Constant(kDirections, sections, kNothing);
  for (int f = 0; f < faces.cols(); ++f)
    if (chosen[f]) Cut(vertices, faces, f);
  FillGaps();
}

// Where the planes of the sections cross the sides of a face.
void SectionTube::Cut(const Points& vertices, const Faces& faces, int f) {
  for (int c = 0; c < 3; ++c) {
    const Vector3d a = vertices.col(faces(c, f)) - start_;
    const Vector3d b = vertices.col(faces((c + 1) % 3, f)) - start_;
    const double ta = a.dot(axis_), tb = b.dot(axis_);
    const int first =
        std::max(0, static_cast<int>(std::ceil(std::min(ta, tb) / spacing_)));
    for (int s = first; s < reach_.cols() && s * spacing_ <= std::max(ta, tb);
         ++s) {
      const double t = ta == tb ? 0.0 : (s * spacing_ - ta) / (tb - ta);
      const Vector3d p = a + t * (b - a);
      const double x = u_.dot(p), y = v_.dot(p);
      for (int k = 0; k < kDirections; ++k)
        reach_(k, s) = std::max(reach_(k, s), cosine_[k] * x + sine_[k] * y);
    }
  }
}

void SectionTube::FillGaps() {
  const auto sections = static_cast<int>(reach_.cols());
  const auto known = [&](int s) { return reach_(0, s) > kNothing; };
  int last = 0;
  while (last < sections && !known(last)) ++last;
  if (last == sections)
    throw InputError("no part of the body lies across the axis of a tube");
  for (int s = 0; s < last; ++s) reach_.col(s) = reach_.col(last);
  for (int s = last; s < sections; ++s) {
    if (known(s)) {
      last = s;
    } else {
      reach_.col(s) = reach_.col(last);
    }
  }
}

void SectionTube::Hang(double narrowing, double widening) {
  for (int s = 1; s < reach_.cols(); ++s) Follow(s, s - 1, -narrowing);
  for (auto s = static_cast<int>(reach_.cols()) - 2; s >= 0; --s)
    Follow(s, s + 1, -widening);
}

void SectionTube::Flare(double t, double rate) {
  const int first = std::max(static_cast<int>(t / spacing_), 0);
  for (int s = first + 1; s < reach_.cols(); ++s) Follow(s, s - 1, rate);
}

void SectionTube::Follow(int section, int neighbour, double rate) {
  for (int k = 0; k < kDirections; ++k)
    reach_(k, section) =
        std::max(reach_(k, section), reach_(k, neighbour) + rate * spacing_);
}

double SectionTube::Along(const Vector3d& x) const {
  return (x - start_).dot(axis_);
}

double SectionTube::Value(const Vector3d& x) const {
  const Vector3d p = x - start_;
  const double t = p.dot(axis_);
  const double s = std::clamp(
      t / spacing_, 0.0, static_cast<double>(reach_.cols() - 1) - 1e-9);
  const int k = static_cast<int>(s);
  const double w = s - k;
  const double x_u = u_.dot(p), x_v = v_.dot(p);
  double radial = kNothing;
  for (int d = 0; d < kDirections; ++d)
    radial = std::max(radial,
                      cosine_[d] * x_u + sine_[d] * x_v -
                          (1.0 - w) * reach_(d, k) - w * reach_(d, k + 1));
  return std::max(radial, -t);
}

}  // namespace invsim
