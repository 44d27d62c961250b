// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_STUDY_HARD_FIT_CASES_H_
#define INVSIM_SRC_STUDY_HARD_FIT_CASES_H_

// The parts of HardFitCases(), and what they are made of.

#include <vector>

#include "invsim/study/hard_fit.h"

namespace invsim {

void AddDataCases(std::vector<HardFitCase>* cases);
void AddOptimiserCases(std::vector<HardFitCase>* cases);

// The person of most cases: arms down, a slow turn. `shape` is the first
// coefficient.
BodySequence HardFitTruth(int frames, double shape = 1);
// What is measured of a body in the cases' tank top, 400 points a frame.
std::vector<Points> HardFitClouds(const BodySequence& truth);

// Three frames, begun near the truth: what cases change in one respect.
HardFit PlainFit(int frames = 3);

// No distances from vertices to points: they draw what was not measured to the
// nearest point that was.
void MeasureFromPointsAlone(HardFit* fit);

// Sets an option of the fit or the scene by its key ("lm.iterations").
void SetOption(HardFit* fit, const std::string& key, const std::string& value);

}  // namespace invsim

#endif  // INVSIM_SRC_STUDY_HARD_FIT_CASES_H_
