// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_STUDY_FAULTY_EFFECT_H_
#define INVSIM_SRC_STUDY_FAULTY_EFFECT_H_

// Fault injection: an effect without any influence on the cloth until it is
// told to break what it adds. It is in no registry; an experiment puts it among
// the effects of its own simulator.

#include <functional>
#include <memory>

#include "invsim/cloth/effect.h"

namespace invsim {

enum class Fault {
  kForce,      // a force that is not a number: no solution
  kStiffness,  // a matrix that is not positive definite: no factor
  kTangent     // a tangent that is not a number: no derivative
};

// `strikes` is asked at every assembly of what breaks, with the state it is
// assembled at; for kTangent from several threads at once.
std::unique_ptr<Effect> MakeFaultyEffect(
    Fault fault, std::function<bool(const ClothState&)> strikes);

}  // namespace invsim

#endif  // INVSIM_SRC_STUDY_FAULTY_EFFECT_H_
