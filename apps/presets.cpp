// SPDX-License-Identifier: Apache-2.0
#include "presets.h"

#include <utility>

namespace invsim {
namespace {

constexpr char kKey[] = "fit.preset";

}  // namespace

const std::vector<Preset>& Presets() {
  static const std::vector<Preset> presets = {
      {"draft",
       "a first look: two steps a frame, dressed once, three iterations",
       R"(step.substeps = 2
fit.dressings = 1
lm.iterations = 3
)"},
      {"balanced", "the defaults", ""},
      {"precise",
       "the cloth nearer, for twice the simulation: eight steps a frame",
       R"(step.substeps = 8
)"},
  };
  return presets;
}

void Describe(OptionTable* table, PresetChoice* choice) {
  OptionInfo info;
  info.doc =
      "settings of several dials at once, beneath all that is set by hand";
  for (const Preset& preset : Presets()) info.choices.push_back(preset.name);
  table->Add("preset", &choice->name, std::move(info));
}

void ApplyPreset(Config* config) {
  const auto found = config->entries().find(kKey);
  if (found == config->entries().end()) return;
  const auto* name = std::get_if<std::string>(&found->second.value);
  for (const Preset& preset : Presets()) {
    if (!name || preset.name != *name) continue;
    Config merged = Config::FromText(preset.settings, "preset " + preset.name);
    merged.Merge(*config);
    *config = std::move(merged);
    return;
  }
}

}  // namespace invsim
