// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/effects/self_contact.h"

namespace invsim {

void Describe(OptionTable* table, SelfContactOptions* o) {
  table->Add("thickness",
             &o->thickness,
             {.doc = "distance kept between layers of cloth",
              .unit = "m",
              .above = 0});
  table->Add("friction",
             &o->friction,
             {.doc = "Coulomb friction of cloth on cloth", .at_least = 0});
  table->Add("margin",
             &o->margin,
             {.doc = "distance beyond the thickness in which contacts are "
                     "sought, besides what relative motion needs",
              .unit = "m",
              .above = 0});
  table->Add("recovery_speed",
             &o->recovery_speed,
             {.doc = "fastest parting of layers nearer than the thickness",
              .unit = "m/s",
              .above = 0});
  table->Add("compliance",
             &o->compliance,
             {.doc = "compliance of the contacts", .unit = "dt/m", .above = 0});
}

}  // namespace invsim
