// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CLOTH_EFFECTS_STIFFNESS_DAMPING_H_
#define INVSIM_CLOTH_EFFECTS_STIFFNESS_DAMPING_H_

// Damping of deformation, the stiffness half of Rayleigh damping:
//
//   f = -beta K(x) v,   D = beta K(x),
//
// with K the positive semi-definite stiffness of membrane and bending, each
// with its own time constant beta (s). A mode of angular frequency omega is
// damped with ratio beta omega / 2; rigid motion is not damped at all as far as
// K leaves it alone (it does: K annihilates translations always, rotations
// when the cloth is not under tension).
//
// D is exactly -df/dv. The stand-in for -df/dx is zero; what it leaves out is
// beta (dK/dx : v), which AddTangent has.

#include <memory>
#include <vector>

#include "invsim/base/options.h"
#include "invsim/cloth/elastic_effect.h"

namespace invsim {

struct StiffnessDampingOptions {
  double membrane = 1e-3;  // s
  double bending = 1e-3;   // s
};
void Describe(OptionTable* table, StiffnessDampingOptions* options);

class StiffnessDamping : public Effect {
 public:
  // One elastic effect and its time constant, s.
  struct Term {
    std::unique_ptr<ElasticEffect> elastic;
    double time;
  };
  explicit StiffnessDamping(std::vector<Term> terms);

  std::string name() const override { return "stiffness_damping"; }
  bool conservative() const override { return false; }
  bool stiffness_is_approximate() const override { return true; }
  bool depends_on_velocity() const override { return true; }

  void AddStencils(BlockPatternBuilder* builder) const override;
  void Bind(const BlockPattern& pattern) override;
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
  std::vector<Term> terms_;
};

}  // namespace invsim

#endif  // INVSIM_CLOTH_EFFECTS_STIFFNESS_DAMPING_H_
