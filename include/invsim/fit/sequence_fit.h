// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_FIT_SEQUENCE_FIT_H_
#define INVSIM_FIT_SEQUENCE_FIT_H_

// From point clouds to the body under the clothes and the moving garment.
//
//   1. A first body for every frame, from the points alone (body_init.h).
//   2. The garment is put on the body of frame 0 and comes to rest there
//      (dressing.h).
//   3. Inverse simulation: an optimiser moves shape, poses and translations
//      until the simulated, clothed body meets the points (objective.h,
//      cloth_points_term.h; the paper's eq. 5).
//   4. The garment is simulated once more at the solution, and the uncertainty
//      of the unknowns is found there.
//
// The garment of stage 3 hangs as it was put on a body that was not known yet,
// and friction remembers that. So stages 2 and 3 are gone through again, from
// the body found, `dressings` times in all, and the round of least cost is
// kept. A later round whose first step shows that it will not come below is
// given up (Optimizer::first_step_gains_most).
//
// With a checkpoint folder each stage leaves its result there, and every
// evaluation of stage 3 (remembered_term.h). Called again with the same folder
// the fit goes on where it was, and ends in the same result; from other inputs
// it refuses to. Stages are left out when the time limit is reached, but what
// was not found in full is not kept there.

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "invsim/fit/body_init.h"
#include "invsim/fit/cloth_points_term.h"
#include "invsim/fit/dressing.h"
#include "invsim/fit/input_digests.h"
#include "invsim/fit/optimizer.h"
#include "invsim/fit/uncertainty.h"
#include "invsim/sim/relaxation.h"

namespace invsim {

struct FitOptions {
  FitOptions();

  BodyInitOptions init;
  RelaxationOptions relaxation;
  ClothPointsOptions data;
  PriorOptions priors;
  std::string optimizer = "lm";
  // The options of every optimiser by name, chosen or not.
  std::map<std::string, std::unique_ptr<Choice<Optimizer>>> optimizers;
  // At most; less if one gave no better body than the one before.
  int dressings = 2;
  bool uncertainty = true;
  double time_limit = 0;  // s, of all stages; 0: none
};
// Keys init.*, relaxation.*, data.*, priors.*, fit.*, and those of every
// optimiser under its name.
void Describe(OptionTable* table, FitOptions* options);

// The simulator of a fit, which it must outlive. Asked for once stage 1 has
// found how the body moves: by that one may choose the effects.
using SimulatorMaker = std::function<Simulator*(const BodySequence& start)>;

struct FitScene {
  const BodyModel& body;
  const Garment& garment;  // around the T-posed body of shape zero
  SimulatorMaker make_simulator;
  const std::vector<Points>& clouds;  // one per frame, metres, y up
  double frames_per_second;
  // Where to start instead of stages 1 and 2; with a reference nothing is
  // dressed again.
  std::optional<BodySequence> start = {};
  std::optional<ClothReference> reference = {};
  // False: stages 1, 2 and 4 only.
  bool optimize = true;
  std::uint64_t seed = 0;
  std::string checkpoint = "";  // an existing folder; "": none
  // What the simulator and the options are made from, of which a checkpoint
  // could not know otherwise.
  InputDigests more_inputs = {};
};

// An iteration of stage 3 and the point kept after it.
struct FitIteration {
  const IterationRecord& record;
  const BodySequence& body;
  long steps;  // of simulation, since stage 3 first began
};

// Told what goes on; any may be empty. Answers of false ask for a stop.
struct FitObserver {
  InitObserver init;
  RelaxationCallback relaxation;
  std::function<bool(const FitIteration&)> iteration;
  // Frames of the final simulation, in order.
  FrameCallback frame;
};

struct FitSeconds {
  double init = 0, dressing = 0, optimization = 0, final_simulation = 0;
  double uncertainty = 0;  // without the simulation at the solution
};

// Stages 2 and 3, gone through once.
struct FitRound {
  Dressing dressing;
  // None if there was nothing to optimise, or no time.
  std::optional<OptimizerSummary> optimizer;
};

struct FitResult {
  // kConverged also where there was nothing to optimise; kTimeLimit and
  // kInterrupted whatever stage they met.
  Termination termination = Termination::kFailed;
  std::string reason;      // one sentence
  bool simulated = false;  // whether there is cloth, that is stage 4 was done

  BodySequence start;  // of the first round
  BodySequence body;
  std::optional<BodyInit> init;
  std::vector<FitRound> rounds;
  int kept = -1;           // of the rounds: `body` is its; -1: nothing was worn
  ClothPointsCosts costs;  // at `body`
  ClothPointsStats stats;  // of stages 3 and 4
  std::optional<Uncertainty> uncertainty;
  int recalled = 0;        // answers found in the checkpoint
  bool resumable = false;  // the checkpoint has something to go on from
  FitSeconds seconds;

  bool usable() const {
    return simulated && termination != Termination::kFailed;
  }
  // Of the round kept; null if there is none.
  const OptimizerSummary* optimizer() const;
  const ClothReference* reference() const;
  // Of all rounds; the cost is that of the first start, 0 if there was none.
  double initial_cost() const;
  ObjectiveCounts counts() const;
  double linear_solver_seconds() const;
  int iterations() const;
};

// What FitSequence does first: throws InputError if `scene.checkpoint` was
// begun from other inputs, and notes them if it is new.
void CheckInputs(const FitScene& scene);

// Throws InputError for points that cannot be a person's, a start that is not
// finite or not of as many frames, or a checkpoint that cannot be written or
// is of other inputs.
FitResult FitSequence(const FitScene& scene,
                      const FitOptions& options,
                      const FitObserver& observer);

}  // namespace invsim

#endif  // INVSIM_FIT_SEQUENCE_FIT_H_
