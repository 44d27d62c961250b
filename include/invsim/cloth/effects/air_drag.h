// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CLOTH_EFFECTS_AIR_DRAG_H_
#define INVSIM_CLOTH_EFFECTS_AIR_DRAG_H_

// Drag of the air, which moves with a uniform wind.
//
// A face of area A and unit normal n (both of the moment) meets the air at
// u = wind - mean velocity of its vertices, u = u_n n + u_t. The air pushes it
// with
//
//   F = A [ (l_n + rho c_n |u_n| / 2) u_n n + (l_t + rho c_t |u_t| / 2) u_t ]
//
// a third on each vertex. rho: density of air; c_n, c_t: dimensionless drag
// coefficients of the quadratic law, across and along the face; l_n, l_t:
// coefficients of a linear law (N s/m^3), both zero unless asked for. The
// defaults are a square plate across the stream, c_n = 1.17 (Hoerner, "Fluid-
// Dynamic Drag", 1965, ch. 3), and a smooth plate along it at the Reynolds
// numbers of clothes, both sides together, c_t = 0.01 (same, ch. 2). Neighbour
// faces do not shelter each other.
//
// D = -df/dv exactly; it is positive semi-definite. The stand-in for -df/dx is
// zero; what it leaves out is the turning and growing of the faces, which
// AddTangent has.

#include <array>
#include <vector>

#include "invsim/base/options.h"
#include "invsim/cloth/effect.h"

namespace invsim {

struct AirDragOptions {
  Vector3d wind = Vector3d::Zero();  // m/s
  double air_density = 1.2;          // rho, kg/m^3
  double normal = 1.17;              // c_n
  double tangential = 0.01;          // c_t
  double linear_normal = 0.0;        // l_n, N s/m^3
  double linear_tangential = 0.0;    // l_t, N s/m^3
};
void Describe(OptionTable* table, AirDragOptions* options);

class AirDrag : public Effect {
 public:
  AirDrag(const Faces& faces, const AirDragOptions& options);

  std::string name() const override { return "air_drag"; }
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
  std::vector<std::array<int, 3>> faces_;
  AirDragOptions options_;
  StencilSlots<3> slots_;
};

}  // namespace invsim

#endif  // INVSIM_CLOTH_EFFECTS_AIR_DRAG_H_
