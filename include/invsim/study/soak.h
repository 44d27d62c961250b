// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_STUDY_SOAK_H_
#define INVSIM_STUDY_SOAK_H_

// Many random scenes one after the other, and what they showed together.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "invsim/study/hard_scene.h"
#include "invsim/study/random_scene.h"

namespace invsim {

struct SoakFailure {
  std::uint64_t seed = 0;
  std::string words;  // the scene
  std::vector<Breach> broken;
};

struct SoakResult {
  std::uint64_t first_seed = 0;
  int scenes = 0;
  int frames = 0;
  StepStats step;           // over all scenes
  int scenes_missed = 0;    // with a step above the contact tolerance
  int scenes_halved = 0;    // with a step that was halved
  int scenes_touching = 0;  // with a contact
  // The worst of any scene.
  double penetration = 0;  // m
  double energy = 0;       // relative
  double derivative = 0;   // relative
  int derivatives = 0;     // scenes whose derivative was compared
  int columns = 0, switched = 0;
  double seconds = 0;
  std::vector<SoakFailure> failures;
  // Scenes beyond a known border (KnownBorder) and no failure otherwise.
  std::map<std::string, std::vector<std::uint64_t>> borders;

  void Add(const RandomScene& drawn, const HardOutcome& outcome);
};

}  // namespace invsim

#endif  // INVSIM_STUDY_SOAK_H_
