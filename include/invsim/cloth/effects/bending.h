// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CLOTH_EFFECTS_BENDING_H_
#define INVSIM_CLOTH_EFFECTS_BENDING_H_

// Bending by hinges: every edge between two faces resists the change of its
// angle theta (see Hinge) with a moment m(phi) = k(|phi|) phi, phi = theta -
// theta_rest (see BendingCurve).
//
//   W = integral of m,   f = -m grad theta,   K = k grad theta grad theta^T.
//
// K leaves out the curvature of theta itself (m times its Hessian, indefinite)
// and the change of k with the angle.
//
// theta_rest is zero, or the angle of the placed garment if that is the rest
// shape (Garment::rest_angles_from_placed). Seams are hinges like others: the
// sewn cloth wants to be flat across them. Lengths and areas are those of the
// pattern; at a seam whose two sides differ in length, their mean.

#include <array>
#include <vector>

#include "invsim/cloth/effects/bending_curve.h"
#include "invsim/cloth/effects/hinge.h"
#include "invsim/cloth/elastic_effect.h"
#include "invsim/cloth/garment.h"

namespace invsim {

class Bending : public ElasticEffect {
 public:
  Bending(const Garment& garment, const BendingModel& model);

  std::string name() const override { return "bending"; }
  bool conservative() const override { return true; }
  bool stiffness_is_approximate() const override { return true; }

  void AddStencils(BlockPatternBuilder* builder) const override;
  void Bind(const BlockPattern& pattern) override;
  double Energy(const ClothState& y) const override;
  void AddForce(const ClothState& y, Points* force) const override;
  void AddStiffness(const ClothState& y,
                    double x_scale,
                    double v_scale,
                    BlockMatrix* a) const override;
  void AddTangent(const ClothState& y,
                  const Points& dx,
                  const Points& dv,
                  double scale,
                  BlockMatrix* h_x,
                  BlockMatrix* h_v) const override;
  void AddStiffnessProduct(const Points& x,
                           const Points& w,
                           double scale,
                           Points* out) const override;
  void AddStiffnessProductTangent(const Points& x,
                                  const Points& w,
                                  double scale,
                                  BlockMatrix* h) const override;

 private:
  struct Element {
    std::array<int, 4> vertices;  // edge a, b, then the vertices opposite
    double rest_length;           // m
    double rest_areas[2];         // m^2
    double rest_angle;
    BendingCurve curve;
  };
  enum class Part { kForceAndProduct, kProduct };

  void AddDerivative(Part part,
                     const Points& x,
                     const Points& w,
                     double scale,
                     BlockMatrix* h) const;

  std::vector<Element> elements_;
  StencilSlots<4> slots_;
};

}  // namespace invsim

#endif  // INVSIM_CLOTH_EFFECTS_BENDING_H_
