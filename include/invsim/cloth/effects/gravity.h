// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CLOTH_EFFECTS_GRAVITY_H_
#define INVSIM_CLOTH_EFFECTS_GRAVITY_H_

// Uniform gravity: f_i = m_i g, W = -sum_i m_i g . x_i, K = D = 0 exactly.

#include "invsim/base/options.h"
#include "invsim/cloth/effect.h"

namespace invsim {

struct GravityOptions {
  // 9.8, as in the sequences this project is measured on.
  Vector3d acceleration = Vector3d(0.0, -9.8, 0.0);  // m/s^2
};
void Describe(OptionTable* table, GravityOptions* options);

class Gravity : public Effect {
 public:
  // `masses` of the vertices, kg.
  Gravity(const VectorXd& masses, const GravityOptions& options);

  std::string name() const override { return "gravity"; }
  bool conservative() const override { return true; }
  bool stiffness_is_approximate() const override { return false; }

  void AddStencils(BlockPatternBuilder* builder) const override {}
  void Bind(const BlockPattern& pattern) override {}
  double Energy(const ClothState& y) const override;
  void AddForce(const ClothState& y, Points* force) const override;
  void AddStiffness(const ClothState& y,
                    double x_scale,
                    double v_scale,
                    BlockMatrix* a) const override {}
  void AddTangent(const ClothState& y,
                  const Points& dx,
                  const Points& dv,
                  double scale,
                  BlockMatrix* h_x,
                  BlockMatrix* h_v) const override {}

 private:
  Points weights_;  // N
};

}  // namespace invsim

#endif  // INVSIM_CLOTH_EFFECTS_GRAVITY_H_
