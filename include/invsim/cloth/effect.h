// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CLOTH_EFFECT_H_
#define INVSIM_CLOTH_EFFECT_H_

// An effect is one physical influence on the cloth: membrane, bending,
// gravity, damping, air drag. A scene lists the effects it wants; what is not
// listed is never built, assembled or differentiated.
//
// The simulator solves, per sub-step, the linearly implicit equation
//
//   M (v1 - v0)/dt = r + f(y) - K(y) Dx - D(y) Dv,                        (*)
//   Dx = x0 + dt v1 - y.x,   Dv = v1 - y.v,
//
// about a state y (the state at the start, or the last iterate when a step is
// re-linearised). K and D are symmetric positive semi-definite stand-ins for
// -df/dx and -df/dv, so that (*) is a strictly convex problem. The derivative
// of the step then needs the derivative of the right side of (*) with respect
// to y at fixed Dx, Dv: `AddTangent`. At Dx = Dv = 0 it is the exact
// stiffness and damping.

#include <memory>
#include <string>

#include "invsim/algebra/block_matrix.h"
#include "invsim/base/types.h"

namespace invsim {

// Positions (m) and velocities (m/s) of the cloth.
struct ClothState {
  Points x;
  Points v;
};

class Effect {
 public:
  virtual ~Effect() = default;

  // The registered name, e.g. "membrane".
  virtual std::string name() const = 0;

  // Whether f = -dE/dx of `Energy` (true for elastic effects and gravity).
  virtual bool conservative() const = 0;
  // Whether K of AddStiffness is only a PSD approximation of -df/dx; if
  // false they are equal. Reported, and tested for every registered effect.
  virtual bool stiffness_is_approximate() const = 0;

  // Whether f depends on y.v, or D is not zero: damping, air drag. Effects
  // that say no are not asked for D.
  virtual bool depends_on_velocity() const { return false; }

  // Adds the vertex tuples this effect couples.
  virtual void AddStencils(BlockPatternBuilder* builder) const = 0;
  // Called once with the scene's final pattern, before any assembly.
  virtual void Bind(const BlockPattern& pattern) = 0;

  // Potential energy, J. Zero for effects that are not conservative.
  virtual double Energy(const ClothState& y) const = 0;

  // force += f(y), newtons.
  virtual void AddForce(const ClothState& y, Points* force) const = 0;

  // a += x_scale K(y) + v_scale D(y); K in N/m, D in N s/m, both symmetric
  // positive semi-definite.
  virtual void AddStiffness(const ClothState& y,
                            double x_scale,
                            double v_scale,
                            BlockMatrix* a) const = 0;

  // With g(y) = -f(y) + K(y) dx + D(y) dv and dx, dv held fixed, exactly:
  //   h_x += scale dg/dy.x,   h_v += scale dg/dy.v .
  virtual void AddTangent(const ClothState& y,
                          const Points& dx,
                          const Points& dv,
                          double scale,
                          BlockMatrix* h_x,
                          BlockMatrix* h_v) const = 0;
};

}  // namespace invsim

#endif  // INVSIM_CLOTH_EFFECT_H_
