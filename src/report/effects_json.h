// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_REPORT_EFFECTS_JSON_H_
#define INVSIM_SRC_REPORT_EFFECTS_JSON_H_

#include <nlohmann/json.hpp>
#include <vector>

#include "invsim/sim/effect_choice.h"

namespace invsim {

inline nlohmann::ordered_json EffectsJson(
    const std::vector<EffectDecision>& effects) {
  nlohmann::ordered_json json;
  for (const EffectDecision& d : effects)
    json[d.name] = {{"on", d.on}, {"reason", d.reason}};
  return json;
}

}  // namespace invsim

#endif  // INVSIM_SRC_REPORT_EFFECTS_JSON_H_
