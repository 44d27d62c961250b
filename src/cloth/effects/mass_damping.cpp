// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/effects/mass_damping.h"

namespace invsim {

void Describe(OptionTable* table, MassDampingOptions* options) {
  table->Add(
      "rate",
      &options->rate,
      {.doc = "rate at which motion dies away", .unit = "1/s", .at_least = 0});
}

MassDamping::MassDamping(const VectorXd& masses,
                         const MassDampingOptions& options)
    : coefficients_(options.rate * masses) {}

void MassDamping::AddForce(const ClothState& y, Points* force) const {
  *force -= y.v * coefficients_.asDiagonal();
}

void MassDamping::AddStiffness(const ClothState& y,
                               double x_scale,
                               double v_scale,
                               BlockMatrix* a) const {
  for (int i = 0; i < coefficients_.size(); ++i)
    a->diagonal(i).diagonal().array() += v_scale * coefficients_[i];
}

void MassDamping::AddTangent(const ClothState& y,
                             const Points& dx,
                             const Points& dv,
                             double scale,
                             BlockMatrix* h_x,
                             BlockMatrix* h_v) const {
  AddStiffness(y, 0.0, scale, h_v);
}

}  // namespace invsim
