// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/soak.h"

#include <algorithm>
#include <exception>

namespace invsim {

void SoakResult::Add(const RandomScene& drawn, const HardOutcome& outcome) {
  ++scenes;
  frames += outcome.frames;
  step.Add(outcome.step);
  scenes_missed += outcome.step.missed > 0;
  scenes_halved += outcome.step.halved > 0;
  penetration = std::max(penetration, outcome.penetration);
  energy = std::max(energy, outcome.energy);
  columns += outcome.columns;
  switched += outcome.switched;
  if (outcome.columns > 0) {
    ++derivatives;
    derivative = std::max(derivative, outcome.derivative);
  }
  seconds += outcome.seconds;
  if (!outcome.broken.empty())
    failures.push_back({drawn.seed, drawn.words, outcome.broken});
}

HardOutcome RunRandomScene(const RandomScene& drawn) {
  try {
    return RunHardScene(drawn.scene, drawn.derivative);
  } catch (const std::exception& error) {
    HardOutcome outcome;
    outcome.broken.push_back({"throws", error.what()});
    return outcome;
  }
}

}  // namespace invsim
