// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/soak.h"

#include <algorithm>
#include <utility>

namespace invsim {

void SoakResult::Add(const RandomScene& drawn, const HardOutcome& outcome) {
  ++scenes;
  frames += outcome.frames;
  step.Add(outcome.step);
  scenes_missed += outcome.step.missed > 0;
  scenes_halved += outcome.step.halved > 0;
  scenes_touching +=
      outcome.step.most_contacts + outcome.step.most_cloth_contacts > 0;
  penetration = std::max(penetration, outcome.penetration);
  energy = std::max(energy, outcome.energy);
  columns += outcome.columns;
  switched += outcome.switched;
  if (outcome.columns > 0) {
    ++derivatives;
    derivative = std::max(derivative, outcome.derivative);
  }
  seconds += outcome.seconds;
  SoakFailure failure{drawn.seed, drawn.words, {}};
  std::string border;
  for (const Breach& breach : outcome.broken) {
    border = KnownBorder(drawn, outcome, breach);
    if (border.empty()) failure.broken.push_back(breach);
  }
  if (!failure.broken.empty())
    failures.push_back(std::move(failure));
  else if (!border.empty())
    borders[border].push_back(drawn.seed);
}

}  // namespace invsim
