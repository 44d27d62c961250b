// SPDX-License-Identifier: Apache-2.0
// The options of a step, and the sums of what steps did.
#include <algorithm>

#include "invsim/base/options.h"
#include "invsim/sim/simulator.h"

namespace invsim {

void Describe(OptionTable* table, FrictionOptions* o) {
  table->Add("tolerance",
             &o->tolerance,
             {.doc = "residual of the contact law and of momentum at which a "
                     "step is solved",
              .unit = "vertex weights",
              .above = 0});
  table->Add(
      "admm_iterations",
      &o->admm_iterations,
      {.doc = "splitting iterations, at most, before Newton", .at_least = 0});
  table->Add("newton_iterations",
             &o->newton_iterations,
             {.doc = "semismooth Newton iterations before splitting is asked "
                     "again",
              .at_least = 1});
  table->Add("retries",
             &o->retries,
             {.doc = "how often splitting is asked again, each time twice as "
                     "long",
              .at_least = 0,
              .at_most = 10});
  table->Add("krylov_tolerance",
             &o->krylov_tolerance,
             {.doc = "relative linear residual at which GMRES is done",
              .above = 0,
              .below = 1});
  table->Add("krylov_iterations",
             &o->krylov_iterations,
             {.doc = "GMRES iterations after which the Jacobian is factorised "
                     "anew",
              .at_least = 0});
}

void Describe(OptionTable* table, StepOptions* o) {
  table->Add("substeps",
             &o->substeps,
             {.doc = "linearly implicit steps per frame: more are more "
                     "accurate and less damped",
              .at_least = 1});
  table->Add("newton_iterations",
             &o->newton_iterations,
             {.doc = "linearisations per sub-step; 1 is linearly implicit",
              .at_least = 1});
  table->Add("newton_tolerance",
             &o->newton_tolerance,
             {.doc = "change of velocity at which re-linearising ends",
              .unit = "m/s",
              .above = 0});
  table->Add("max_halvings",
             &o->max_halvings,
             {.doc = "how often a sub-step that misses the contact tolerance "
                     "is halved; twice as often one with energy from nowhere",
              .at_least = 0,
              .at_most = 10});
  table->AddSection("friction", &o->friction);
}

void StepStats::Add(const StepStats& o) {
  substeps += o.substeps;
  linearizations += o.linearizations;
  missed += o.missed;
  halved += o.halved;
  failed += o.failed;
  for (const auto& [why, count] : o.failures) failures[why] += count;
  worst_residual = std::max(worst_residual, o.worst_residual);
  most_contacts = std::max(most_contacts, o.most_contacts);
  factorizations += o.factorizations;
  solves += o.solves;
  contact_queries += o.contact_queries;
  admm_iterations += o.admm_iterations;
  newton_iterations += o.newton_iterations;
  open += o.open;
  stick += o.stick;
  slide += o.slide;
  slip_solves += o.slip_solves;
  yield_solves += o.yield_solves;
  most_cloth_contacts = std::max(most_cloth_contacts, o.most_cloth_contacts);
  sweep_solves += o.sweep_solves;
  stopped += o.stopped;
  most_crossings = std::max(most_crossings, o.most_crossings);
  assembly_seconds += o.assembly_seconds;
  effects.Add(o.effects);
  detection_seconds += o.detection_seconds;
  factor_seconds += o.factor_seconds;
  solve_seconds += o.solve_seconds;
}

}  // namespace invsim
