// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/effects/stiffness_damping.h"

#include <utility>

namespace invsim {

void Describe(OptionTable* table, StiffnessDampingOptions* options) {
  table->Add("membrane",
             &options->membrane,
             {.doc = "time constant of in-plane damping",
              .unit = "s",
              .at_least = 0.0});
  table->Add("bending",
             &options->bending,
             {.doc = "time constant of the damping of bending",
              .unit = "s",
              .at_least = 0.0});
}

StiffnessDamping::StiffnessDamping(std::vector<Term> terms)
    : terms_(std::move(terms)) {}

void StiffnessDamping::AddStencils(BlockPatternBuilder* builder) const {
  for (const Term& term : terms_) term.elastic->AddStencils(builder);
}

void StiffnessDamping::Bind(const BlockPattern& pattern) {
  for (const Term& term : terms_) term.elastic->Bind(pattern);
}

void StiffnessDamping::AddForce(const ClothState& y, Points* force) const {
  for (const Term& term : terms_)
    term.elastic->AddStiffnessProduct(y.x, y.v, -term.time, force);
}

void StiffnessDamping::AddStiffness(const ClothState& y,
                                    double x_scale,
                                    double v_scale,
                                    BlockMatrix* a) const {
  if (v_scale == 0.0) return;
  for (const Term& term : terms_)
    term.elastic->AddStiffness(y, v_scale * term.time, 0.0, a);
}

// g = beta K(x) (v + dv).
void StiffnessDamping::AddTangent(const ClothState& y,
                                  const Points& dx,
                                  const Points& dv,
                                  double scale,
                                  BlockMatrix* h_x,
                                  BlockMatrix* h_v) const {
  const Points w = y.v + dv;
  for (const Term& term : terms_) {
    const double factor = scale * term.time;
    term.elastic->AddStiffnessProductTangent(y.x, w, factor, h_x);
    term.elastic->AddStiffness(y, factor, 0.0, h_v);
  }
}

}  // namespace invsim
