// SPDX-License-Identifier: Apache-2.0
#include "energy_balance.h"

#include <algorithm>
#include <cmath>

#include "invsim/sim/simulator.h"

namespace invsim {
namespace {

// How far lifting the cloth is too little energy to speak of, m.
constexpr double kLift = 1e-3;

}  // namespace

double KineticEnergy(const VectorXd& mass, const ClothState& state) {
  return 0.5 * (state.v.colwise().squaredNorm() * mass)(0);
}

double PotentialEnergy(const EffectList& effects, const ClothState& state) {
  double energy = 0;
  for (const auto& effect : effects) energy += effect->Energy(state);
  return energy;
}

double EnergyGain(const VectorXd& mass,
                  const EffectList& effects,
                  const SubstepRecord& sub,
                  const ClothState& end) {
  const LinearizationRecord& lin = sub.linearizations.back();
  double given = 0, turnover = kLift * kStandardGravity * mass.sum();
  const auto work = [&](double w) {
    given += w;
    turnover += std::abs(w);
  };
  for (size_t k = 0; k < sub.contacts.size(); ++k)
    work(sub.dt * lin.forces[k].dot(sub.contacts[k].Gather(lin.v)));
  for (const auto& effect : effects) {
    if (effect->conservative()) continue;
    Points force = Points::Zero(3, end.x.cols());
    effect->AddForce(end, &force);
    work(std::max(0.0, sub.dt * Stacked(force).dot(lin.v)));
  }
  const double kinetic = KineticEnergy(mass, end);
  const double before =
      KineticEnergy(mass, sub.start) + PotentialEnergy(effects, sub.start);
  const double after = kinetic + PotentialEnergy(effects, end);
  turnover += std::max(kinetic, std::abs(after - before));
  return (after - before - given) / turnover;
}

}  // namespace invsim
