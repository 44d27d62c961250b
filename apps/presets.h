// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_APPS_PRESETS_H_
#define INVSIM_APPS_PRESETS_H_

// Named settings of several dials of a fit at once, chosen from measurements
// (docs/inverse_study.md). They stand between the defaults and what the user
// sets: whatever a file, --set or a flag says wins.

#include <string>
#include <vector>

#include "invsim/base/config.h"
#include "invsim/base/options.h"

namespace invsim {

struct Preset {
  std::string name;
  std::string doc;
  std::string settings;  // TOML
};

// From fast to accurate.
const std::vector<Preset>& Presets();

// The key "fit.preset".
struct PresetChoice {
  std::string name = "balanced";
};
void Describe(OptionTable* table, PresetChoice* choice);

// Puts the settings of the preset that `config` names under its own. A name
// that is none is left for the option to refuse.
void ApplyPreset(Config* config);

}  // namespace invsim

#endif  // INVSIM_APPS_PRESETS_H_
