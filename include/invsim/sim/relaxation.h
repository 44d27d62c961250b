// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SIM_RELAXATION_H_
#define INVSIM_SIM_RELAXATION_H_

// Dressing: the garment, placed around the T-posed body, is led to rest on the
// body in the first pose of a sequence (the paper's "cloth relaxation").
//
//   settle   the T-posed body stands still, the garment falls onto it
//   move     the body goes to the wanted shape and the first pose
//   hold     it stays there until the cloth is at rest
//   lead in  (if asked for) it gathers the speed of the first frames
//
// Without a lead-in the sequence begins with cloth at rest on a body that
// moves at once with the velocity of its first two frames: right for a person
// who stands at first, a jolt for one already walking. With one the body is
// led back in time along its initial velocity (BeforeFirst), held there, and
// sets out so as to pass through the first frame at the right speed; the
// price is a path that was not measured. The default is none: a fit's first
// frame is then at rest, and nothing depends on invented motion.
//
// Steps are of one length, whatever the sequence is simulated with: its
// sub-steps are a choice of accuracy, and longer ones make the arms that come
// down press so much cloth at once that steps miss their tolerance and are
// halved, which costs more than it saves.
//
// Where settling and holding, the cloth's velocity is taken away at the rate
// `damping`: what is sought there is a rest, not the way to it.

#include <functional>
#include <span>
#include <string>

#include "invsim/base/interrupt.h"
#include "invsim/base/options.h"
#include "invsim/body/body_model.h"
#include "invsim/cloth/garment.h"
#include "invsim/sim/rollout.h"

namespace invsim {

struct RelaxationOptions {
  double settle_seconds = 0.2;
  double move_seconds = 0.6;
  double hold_seconds = 2.0;  // at most
  double rest_speed = 0.01;   // m/s
  double lead_in_seconds = 0.0;
  double damping = 5.0;           // 1/s
  double steps_per_second = 120;  // whatever step.substeps is
};
void Describe(OptionTable* table, RelaxationOptions* options);

enum class RelaxationPhase { kSettle, kMove, kHold, kLeadIn };
const char* PhaseName(RelaxationPhase phase);

// A frame of the relaxation.
struct RelaxationFrame {
  RelaxationPhase phase;
  int frame;        // over all phases, from 1
  int most_frames;  // there can be
  const Points& body;
  const ClothState& cloth;
  const FrameStats& stats;
};
using RelaxationCallback = std::function<void(const RelaxationFrame&)>;

struct RelaxationResult {
  RunStatus status = RunStatus::kComplete;
  RelaxationPhase phase = RelaxationPhase::kSettle;  // the last one
  ClothState cloth;                                  // on the first pose
  // Whether holding ended because the cloth was at rest, and with what speed.
  bool at_rest = false;
  double rest_speed = 0;  // m/s, mean over vertices
  int frames = 0;
  FrameStats stats;
};

// What is to be dressed. `motion` holds the sequence, of which the first two
// frames count; `garment_shape` is the shape of the body around which the
// garment was placed.
struct RelaxationScene {
  const BodyModel& body;
  const Garment& garment;
  std::span<const BodyParameters> motion;
  double frames_per_second = 30;
  ShapeVector garment_shape = ShapeVector::Zero();
};

// The body on its way from the T-pose to where it holds, 0 <= s <= 1, with no
// velocity and no acceleration at either end.
BodyParameters DressingBody(const BodyParameters& start,
                            const BodyParameters& goal,
                            double s);

// Ends early if it fails, or, as kInterrupted, if InterruptRequested() or
// `stop` says so.
RelaxationResult Relax(const RelaxationScene& scene,
                       const RelaxationOptions& options,
                       Simulator* simulator,
                       const RelaxationCallback& on_frame = {},
                       const StopPredicate& stop = {});

}  // namespace invsim

#endif  // INVSIM_SIM_RELAXATION_H_
