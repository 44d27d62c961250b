// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/cone_cut.h"

#include <Eigen/Geometry>
#include <cmath>

namespace invsim {

ConeCut::ConeCut(const Vector3d& centre,
                 const Vector3d& axis,
                 const Vector3d& first,
                 const std::array<Anchor, 4>& anchors,
                 double slope)
    : centre_(centre),
      axis_(axis.normalized()),
      first_((first - first.dot(axis_) * axis_).normalized()),
      second_(axis_.cross(first_)),
      anchors_(anchors),
      slope_(slope) {}

ConeCut::Anchor ConeCut::At(double cosine, double sine) const {
  const Anchor& a = anchors_[cosine >= 0.0 ? 0 : 2];
  const Anchor& b = anchors_[sine >= 0.0 ? 1 : 3];
  const double wa = cosine * cosine, wb = sine * sine;
  return {wa * a.height + wb * b.height, wa * a.radius + wb * b.radius};
}

double ConeCut::Value(const Vector3d& x) const {
  const Vector3d p = x - centre_;
  const double c = p.dot(first_), s = p.dot(second_);
  const double radius = std::hypot(c, s);
  const Anchor on = radius > 0.0 ? At(c / radius, s / radius) : At(1.0, 0.0);
  return slope_ * (radius - on.radius) - (p.dot(axis_) - on.height);
}

Vector3d ConeCut::Curve(double psi) const {
  const double c = std::cos(psi), s = std::sin(psi);
  const Anchor on = At(c, s);
  return centre_ + on.height * axis_ + on.radius * (c * first_ + s * second_);
}

}  // namespace invsim
