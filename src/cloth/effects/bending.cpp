// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/effects/bending.h"

#include "invsim/cloth/rest_shape.h"
#include "invsim/geometry/mesh.h"

namespace invsim {
namespace {

Hinge::Vertices Gather(const std::array<int, 4>& v, const Points& x) {
  Hinge::Vertices p;
  for (int a = 0; a < 4; ++a) p.col(a) = x.col(v[a]);
  return p;
}

template <typename Element>
Hinge HingeOf(const Element& e, const Hinge::Vertices& x) {
  return Hinge::At(x, e.rest_length, e.rest_areas[0], e.rest_areas[1]);
}

// The pattern point of vertex v as a corner of face f.
Vector2d PatternPoint(const Garment& garment, int f, int v) {
  int corner = 0;
  while (garment.faces(corner, f) != v) ++corner;
  return garment.rest.col(garment.rest_faces(corner, f));
}

}  // namespace

Bending::Bending(const Garment& garment, const BendingModel& model) {
  for (const Edge& edge : Edges(garment.faces)) {
    if (edge.faces[1] < 0) continue;
    HingeRest rest;
    double areas[2];
    rest.length = 0.0;
    for (int side = 0; side < 2; ++side) {
      const int f = edge.faces[side];
      rest.directions[side] =
          PatternPoint(garment, f, edge.b) - PatternPoint(garment, f, edge.a);
      rest.length += 0.5 * rest.directions[side].norm();
      areas[side] = RestArea(garment, f);
    }
    rest.area = areas[0] + areas[1];
    Element e{{edge.a, edge.b, edge.opposite[0], edge.opposite[1]},
              rest.length,
              {areas[0], areas[1]},
              0.0,
              MakeBendingCurve(model, rest)};
    if (garment.rest_angles_from_placed)
      e.rest_angle = HingeOf(e, Gather(e.vertices, garment.placed)).angle;
    elements_.push_back(e);
  }
}

void Bending::AddStencils(BlockPatternBuilder* builder) const {
  for (const Element& e : elements_) builder->AddStencil(e.vertices);
}

void Bending::Bind(const BlockPattern& pattern) {
  std::vector<std::array<int, 4>> stencils;
  stencils.reserve(elements_.size());
  for (const Element& e : elements_) stencils.push_back(e.vertices);
  slots_ = StencilSlots<4>(pattern, stencils);
}

double Bending::Energy(const ClothState& y) const {
  double energy = 0.0;
  for (const Element& e : elements_) {
    const Hinge hinge = HingeOf(e, Gather(e.vertices, y.x));
    energy += e.curve.Energy(hinge.angle - e.rest_angle);
  }
  return energy;
}

void Bending::AddForce(const ClothState& y, Points* force) const {
  for (const Element& e : elements_) {
    const Hinge hinge = HingeOf(e, Gather(e.vertices, y.x));
    const double bend = hinge.angle - e.rest_angle;
    const double moment = e.curve.At(bend).stiffness * bend;
    for (int a = 0; a < 4; ++a)
      force->col(e.vertices[a]) -= moment * hinge.gradient.col(a);
  }
}

void Bending::AddStiffness(const ClothState& y,
                           double x_scale,
                           double v_scale,
                           BlockMatrix* a) const {
  for (size_t i = 0; i < elements_.size(); ++i) {
    const Element& e = elements_[i];
    const Hinge hinge = HingeOf(e, Gather(e.vertices, y.x));
    const double k = e.curve.At(hinge.angle - e.rest_angle).stiffness;
    const Hinge::Vertices scaled = x_scale * k * hinge.gradient;
    for (int p = 0; p < 4; ++p)
      for (int q = 0; q < 4; ++q) {
        // Written out: a quarter less time than Eigen takes for this assembly.
        double* b = a->block(slots_.slot(i, p, q)).data();
        for (int c = 0; c < 3; ++c)
          for (int r = 0; r < 3; ++r)
            b[3 * c + r] += scaled(r, p) * hinge.gradient(c, q);
      }
  }
}

void Bending::AddStiffnessProduct(const Points& x,
                                  const Points& w,
                                  double scale,
                                  Points* out) const {
  for (const Element& e : elements_) {
    const Hinge hinge = HingeOf(e, Gather(e.vertices, x));
    const double k = e.curve.At(hinge.angle - e.rest_angle).stiffness;
    const double turn =
        hinge.gradient.cwiseProduct(Gather(e.vertices, w)).sum();
    for (int a = 0; a < 4; ++a)
      out->col(e.vertices[a]) += scale * k * turn * hinge.gradient.col(a);
  }
}

void Bending::AddTangent(const ClothState& y,
                         const Points& dx,
                         const Points& dv,
                         double scale,
                         BlockMatrix* h_x,
                         BlockMatrix* h_v) const {
  AddDerivative(Part::kForceAndProduct, y.x, dx, scale, h_x);
}

void Bending::AddStiffnessProductTangent(const Points& x,
                                         const Points& w,
                                         double scale,
                                         BlockMatrix* h) const {
  AddDerivative(Part::kProduct, x, w, scale, h);
}

// With u the gradient of the angle (bounded: hinge.h), U its slope, a how the
// angle turns (u, unless bounded), and turn = u . w, the product K w = k turn u
// has the derivative
//   k' turn u a^T + k u (U^T w)^T + k turn U,
// and -f = m u has (k + k' bend) u a^T + m U.
void Bending::AddDerivative(Part part,
                            const Points& x,
                            const Points& w,
                            double scale,
                            BlockMatrix* h) const {
  using Vector12 = Eigen::Matrix<double, 12, 1>;
  for (size_t i = 0; i < elements_.size(); ++i) {
    const Element& e = elements_[i];
    const Hinge::Vertices vertices = Gather(e.vertices, x);
    const Hinge hinge = HingeOf(e, vertices);
    const Hinge::Slope slope = Hinge::GradientSlope(
        vertices, e.rest_length, e.rest_areas[0], e.rest_areas[1]);
    const double bend = hinge.angle - e.rest_angle;
    const BendingCurve::Value curve = e.curve.At(bend);
    const Vector12 u = hinge.gradient.reshaped();
    Vector12 a = u;
    if (hinge.collapsed) a = Hinge::AngleGradient(vertices).reshaped();
    const Vector12 move = Gather(e.vertices, w).reshaped();
    const double turn = u.dot(move);

    double along = curve.slope * turn;
    double turning = curve.stiffness * turn;
    if (part == Part::kForceAndProduct) {
      along += curve.stiffness + curve.slope * bend;
      turning += curve.stiffness * bend;
    }
    const Vector12 right =
        scale *
        (along * a + curve.stiffness * slope.transpose().lazyProduct(move));
    const Hinge::Slope block =
        u * right.transpose() + (scale * turning) * slope;
    for (int p = 0; p < 4; ++p)
      for (int q = 0; q < 4; ++q)
        h->block(slots_.slot(i, p, q)) += block.block<3, 3>(3 * p, 3 * q);
  }
}

}  // namespace invsim
