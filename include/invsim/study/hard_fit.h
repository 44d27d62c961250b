// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_STUDY_HARD_FIT_H_
#define INVSIM_STUDY_HARD_FIT_H_

// Hard cases for the whole fit, beside those for the simulator alone
// (hard_scene.h): points that are wrong in one way or another, and states in
// which an optimiser may find itself. Each is defined once; the tests and
// `invsim gallery` run what is listed here.
//
// All are small: the mannequin in a tank top of 8 cm triangles, one to four
// frames, a few iterations. What holds in every one:
//
//   finite    body, cloth, costs and uncertainty are numbers
//   downhill  the cost does not end above where it began
//   true      the fit ends as the case says (converged, stalled, failed ...),
//             and is usable just if there is a result
//   told      evaluations that failed are counted, and the reason given
//
// or the input is refused with an InputError of one line.

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "invsim/cloth/effect.h"
#include "invsim/cloth/garment.h"
#include "invsim/fit/sequence_fit.h"
#include "invsim/sim/scene.h"

namespace invsim {

struct HardFit {
  Garment garment;
  SceneOptions scene;
  FitOptions fit;
  std::vector<Points> clouds;
  std::optional<BodySequence> start;  // none: it is found from the points
  // An effect beside those of the scene that fails when it is told to.
  std::unique_ptr<Effect> fault;
  // Told of every iteration, to set off a fault.
  std::function<void(const IterationRecord&)> on_iteration;

  std::optional<BodySequence> truth;
  // In which of these ways it ends; usable: with a result.
  std::vector<Termination> ends = {Termination::kConverged,
                                   Termination::kIterationLimit};
  bool usable = true;
  // Of the body found from the true one, mean over vertices and frames, m.
  // Starts are 0.048 off (HardFitOutcome::start_error).
  double body_error = std::numeric_limits<double>::infinity();
  // What else has to hold; in words what does not, or empty.
  std::function<std::string(const FitResult&)> check;
};

struct HardFitOutcome {
  bool refused = false;  // why: `refusal`
  std::string refusal;
  FitResult result;
  // Of the body from the true one at the start and in the end, m; NaN: there
  // is no truth, or the start was looked for.
  double start_error = std::numeric_limits<double>::quiet_NaN();
  double body_error = std::numeric_limits<double>::quiet_NaN();
  double seconds = 0;
  // What does not hold, in words; empty: the fit holds.
  std::vector<std::string> broken;
};

HardFitOutcome RunHardFit(HardFit fit);

struct HardFitCase {
  std::string name;   // "data/half_outliers"
  std::string shows;  // one line
  std::function<HardFit()> make;
  // Bad input: running it throws InputError, with this in its message; empty:
  // it is no bad input.
  std::string refusal = "";
};

// In the order of the gallery: data, optimiser.
const std::vector<HardFitCase>& HardFitCases();

// Makes and runs a case; of one that is to be refused, whether it is.
HardFitOutcome RunHardFitCase(const HardFitCase& hard);

}  // namespace invsim

#endif  // INVSIM_STUDY_HARD_FIT_H_
