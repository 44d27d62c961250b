// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CLOTH_EFFECTS_INERTIA_H_
#define INVSIM_CLOTH_EFFECTS_INERTIA_H_

// Inertia as an entry in a scene's list of effects. It exerts no force: the
// left side of the step, M (v1 - v0)/dt, belongs to the simulator, which adds
// it (with VertexMasses) if, and only if, a scene lists "inertia". Without it
// every step seeks rest: the cloth moves quasi-statically.

#include "invsim/cloth/effect.h"

namespace invsim {

class Inertia : public Effect {
 public:
  static constexpr char kName[] = "inertia";

  std::string name() const override { return kName; }
  bool conservative() const override { return true; }
  bool stiffness_is_approximate() const override { return false; }

  void AddStencils(BlockPatternBuilder* builder) const override {}
  void Bind(const BlockPattern& pattern) override {}
  double Energy(const ClothState& y) const override { return 0.0; }
  void AddForce(const ClothState& y, Points* force) const override {}
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
};

}  // namespace invsim

#endif  // INVSIM_CLOTH_EFFECTS_INERTIA_H_
