// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CLOTH_EFFECTS_MEMBRANE_H_
#define INVSIM_CLOTH_EFFECTS_MEMBRANE_H_

// In-plane elasticity by constant-strain triangles.
//
// For a face with vertices x_a and rest area A, and d_a in R^2 the gradient in
// the pattern of the hat function of vertex a:
//
//   F  = sum_a x_a d_a^T              deformation gradient, 3 x 2
//   E  = (F^T F - I) / 2              Green strain, 2 x 2
//   S  = C : E                        second Piola-Kirchhoff stress, N/m
//   W  = A/2 S : E                    energy, J (if C is constant)
//   f_a = -A F S d_a                  force, N
//   K_ab = A [F (d_a . C . d_b) F^T + (d_a . S+ d_b) I]
//
// with S+ the tensile part of S. (Bonet & Wood, Nonlinear Continuum Mechanics
// for Finite Element Analysis; C of the material: see StretchLaw.) K leaves
// out the compressive part of S, and for a measured fabric the change of C
// with strain.
//
// A measured fabric is not conservative (see StretchLaw): Energy is zero then.

#include <array>
#include <vector>

#include "invsim/cloth/effects/stretch_law.h"
#include "invsim/cloth/elastic_effect.h"
#include "invsim/cloth/garment.h"

namespace invsim {

// What the membrane feels, one column per face.
struct MembraneFields {
  MatrixXd strain;     // 3 x F: E11, E22, 2 E12 in the pattern's axes
  MatrixXd stress;     // 3 x F: S11, S22, S12 (second Piola-Kirchhoff), N/m
  VectorXd von_mises;  // F: of the Cauchy stress F S F^T / det, N/m
};

class Membrane : public ElasticEffect {
 public:
  Membrane(const Garment& garment, const StretchModel& model);

  std::string name() const override { return "membrane"; }
  bool conservative() const override { return law_.linear(); }
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

  // Strain and stress of every face at positions x.
  MembraneFields Fields(const Points& x) const;

 private:
  struct Element {
    std::array<int, 3> vertices;
    double area;                    // m^2
    Eigen::Matrix<double, 2, 3> d;  // column a: d_a, 1/m
  };
  enum class Part { kForceAndProduct, kProduct };

  void AddDerivative(Part part,
                     const Points& x,
                     const Points& w,
                     double scale,
                     BlockMatrix* h) const;

  std::vector<Element> elements_;
  StretchLaw law_;
  StencilSlots<3> slots_;
};

// Averages a per-face quantity (rows x F) over the faces round each vertex,
// weighted by rest area; rows x N.
MatrixXd FaceToVertexAverage(const Garment& garment, const MatrixXd& per_face);

}  // namespace invsim

#endif  // INVSIM_CLOTH_EFFECTS_MEMBRANE_H_
