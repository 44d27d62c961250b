// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CLOTH_EFFECTS_MASS_DAMPING_H_
#define INVSIM_CLOTH_EFFECTS_MASS_DAMPING_H_

// Damping of all motion, the mass half of Rayleigh damping:
//
//   f_i = -alpha m_i v_i,   D = alpha M,   K = 0, all exact.
//
// Motion dies away as exp(-alpha t) when nothing else acts, rigid motion too.

#include "invsim/base/options.h"
#include "invsim/cloth/effect.h"

namespace invsim {

struct MassDampingOptions {
  double rate = 0.5;  // alpha, 1/s
};
void Describe(OptionTable* table, MassDampingOptions* options);

class MassDamping : public Effect {
 public:
  // `masses` of the vertices, kg.
  MassDamping(const VectorXd& masses, const MassDampingOptions& options);

  std::string name() const override { return "mass_damping"; }
  bool conservative() const override { return false; }
  bool stiffness_is_approximate() const override { return false; }
  bool depends_on_velocity() const override { return true; }

  void AddStencils(BlockPatternBuilder* builder) const override {}
  void Bind(const BlockPattern& pattern) override {}
  double Energy(const ClothState& y) const override { return 0.0; }
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

 private:
  VectorXd coefficients_;  // alpha m_i, N s/m
};

}  // namespace invsim

#endif  // INVSIM_CLOTH_EFFECTS_MASS_DAMPING_H_
