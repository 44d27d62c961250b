// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/effects/gravity.h"

namespace invsim {

void Describe(OptionTable* table, GravityOptions* options) {
  table->Add("acceleration",
             &options->acceleration,
             {.doc = "acceleration of free fall", .unit = "m/s^2"});
}

Gravity::Gravity(const VectorXd& masses, const GravityOptions& options)
    : weights_(options.acceleration * masses.transpose()) {}

double Gravity::Energy(const ClothState& y) const {
  return -weights_.cwiseProduct(y.x).sum();
}

void Gravity::AddForce(const ClothState& y, Points* force) const {
  *force += weights_;
}

}  // namespace invsim
