// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CLOTH_ELASTIC_EFFECT_H_
#define INVSIM_CLOTH_ELASTIC_EFFECT_H_

// Effects whose force depends on positions alone, f(x). Besides the contract
// of Effect they give the product K(x) w and its derivative, which is all that
// stiffness-proportional damping needs of them.

#include "invsim/cloth/effect.h"

namespace invsim {

class ElasticEffect : public Effect {
 public:
  // out += scale K(x) w, with the K of AddStiffness.
  virtual void AddStiffnessProduct(const Points& x,
                                   const Points& w,
                                   double scale,
                                   Points* out) const = 0;

  // h += scale d(K(x) w)/dx with w held fixed, exactly.
  virtual void AddStiffnessProductTangent(const Points& x,
                                          const Points& w,
                                          double scale,
                                          BlockMatrix* h) const = 0;
};

}  // namespace invsim

#endif  // INVSIM_CLOTH_ELASTIC_EFFECT_H_
