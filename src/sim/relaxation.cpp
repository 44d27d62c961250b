// SPDX-License-Identifier: Apache-2.0
#include "invsim/sim/relaxation.h"

#include <cmath>
#include <utility>

#include "invsim/body/motion.h"
#include "invsim/sim/body_path.h"

namespace invsim {
namespace {

// From 0 to 1 with no velocity and no acceleration at either end.
double SmoothStep(double s) { return s * s * s * (s * (6 * s - 15) + 10); }

class Dressing {
 public:
  Dressing(const RelaxationScene& scene,
           const RelaxationOptions& options,
           Simulator* simulator,
           const RelaxationCallback& on_frame,
           const StopPredicate& stop);

  RelaxationResult Run();

 private:
  int Frames(double seconds) const {
    return static_cast<int>(std::ceil(seconds / frame_seconds_));
  }
  // The body of a moment of the lead-in, in seconds before the first frame.
  BodyParameters Before(double seconds) const {
    return BeforeFirst(scene_.motion,
                       scene_.frames_per_second,
                       options_.lead_in_seconds,
                       seconds);
  }
  // One frame; false if the relaxation ends here.
  bool Step(RelaxationPhase phase, const BodyParameters& body, bool damped);
  bool Settle();
  bool Move();
  bool Hold();
  bool LeadIn();

  const RelaxationScene& scene_;
  const RelaxationOptions& options_;
  const RelaxationCallback& on_frame_;
  const StopPredicate& stop_;
  const double frame_seconds_;  // of as many steps as the simulator takes
  StartingPlace start_;
  BodyParameters goal_;  // where it holds
  FrameStepper stepper_;
  RelaxationResult result_;
};

ClothState PlacedGarment(const Garment& garment, const StartingPlace& start) {
  ClothState state;
  state.x = (start.rotation * garment.placed).colwise() + start.translation;
  state.v = Points::Zero(3, garment.placed.cols());
  return state;
}

Dressing::Dressing(const RelaxationScene& scene,
                   const RelaxationOptions& options,
                   Simulator* simulator,
                   const RelaxationCallback& on_frame,
                   const StopPredicate& stop)
    : scene_(scene),
      options_(options),
      on_frame_(on_frame),
      stop_(stop),
      frame_seconds_(simulator->step_options().substeps /
                     options.steps_per_second),
      start_(PlaceAtStart(
          scene.body, Before(-options.lead_in_seconds), scene.garment_shape)),
      goal_(Before(-options.lead_in_seconds)),
      stepper_(simulator,
               scene.body.Vertices(start_.body),
               PlacedGarment(scene.garment, start_)) {}

bool Dressing::Step(RelaxationPhase phase,
                    const BodyParameters& body,
                    bool damped) {
  result_.phase = phase;
  if (StopRequested(stop_)) {
    result_.status = RunStatus::kInterrupted;
    return false;
  }
  const double dt = frame_seconds_;
  FrameStats stats;
  if (!stepper_.Step(scene_.body.Vertices(body), dt, &stats)) {
    result_.stats.step.Add(stats.step);
    result_.status = RunStatus::kFailed;
    return false;
  }
  if (damped) stepper_.ScaleVelocity(std::exp(-options_.damping * dt));
  result_.stats.Add(stats);
  ++result_.frames;
  const int most =
      Frames(options_.settle_seconds) + Frames(options_.move_seconds) +
      Frames(options_.hold_seconds) + Frames(options_.lead_in_seconds);
  if (on_frame_)
    on_frame_({phase,
               result_.frames,
               most,
               stepper_.body(),
               stepper_.state(),
               stats});
  return true;
}

bool Dressing::Settle() {
  for (int k = 0; k < Frames(options_.settle_seconds); ++k)
    if (!Step(RelaxationPhase::kSettle, start_.body, true)) return false;
  return true;
}

bool Dressing::Move() {
  const int frames = Frames(options_.move_seconds);
  for (int k = 1; k <= frames; ++k) {
    const BodyParameters body =
        DressingBody(start_.body, goal_, static_cast<double>(k) / frames);
    if (!Step(RelaxationPhase::kMove, body, false)) return false;
  }
  return true;
}

bool Dressing::Hold() {
  for (int k = 0; k < Frames(options_.hold_seconds); ++k) {
    if (!Step(RelaxationPhase::kHold, goal_, true)) return false;
    result_.rest_speed = MeanSpeed(stepper_.state());
    result_.at_rest = result_.rest_speed < options_.rest_speed;
    if (result_.at_rest) break;
  }
  return true;
}

bool Dressing::LeadIn() {
  const int frames = Frames(options_.lead_in_seconds);
  for (int k = 1; k <= frames; ++k) {
    const double before = (k - frames) * frame_seconds_;
    if (!Step(RelaxationPhase::kLeadIn, Before(before), false)) return false;
  }
  return true;
}

RelaxationResult Dressing::Run() {
  if (Settle() && Move() && Hold()) LeadIn();
  result_.cloth = stepper_.state();
  return std::move(result_);
}

}  // namespace

void Describe(OptionTable* table, RelaxationOptions* o) {
  table->Add("settle_seconds",
             &o->settle_seconds,
             {.doc = "the garment falls onto the T-posed body",
              .unit = "s",
              .at_least = 0});
  table->Add(
      "move_seconds",
      &o->move_seconds,
      {.doc = "from the T-pose to the first pose", .unit = "s", .above = 0});
  table->Add("hold_seconds",
             &o->hold_seconds,
             {.doc = "at most, in the first pose, until the cloth is at rest",
              .unit = "s",
              .at_least = 0});
  table->Add("rest_speed",
             &o->rest_speed,
             {.doc = "mean speed of the cloth that counts as rest",
              .unit = "m/s",
              .above = 0});
  table->Add("lead_in_seconds",
             &o->lead_in_seconds,
             {.doc = "time in which the body gathers the speed of the first "
                     "frames before them; 0: the sequence starts from rest",
              .unit = "s",
              .at_least = 0});
  table->Add("damping",
             &o->damping,
             {.doc = "rate at which velocity is taken away while settling and "
                     "holding",
              .unit = "1/s",
              .at_least = 0});
  table->Add("steps_per_second",
             &o->steps_per_second,
             {.doc = "steps of the relaxation, whatever step.substeps is",
              .unit = "1/s",
              .above = 0});
}

const char* PhaseName(RelaxationPhase phase) {
  switch (phase) {
    case RelaxationPhase::kSettle:
      return "settle";
    case RelaxationPhase::kMove:
      return "move";
    case RelaxationPhase::kHold:
      return "hold";
    case RelaxationPhase::kLeadIn:
      return "lead in";
  }
  return "";
}

BodyParameters DressingBody(const BodyParameters& start,
                            const BodyParameters& goal,
                            double s) {
  return s >= 1 ? goal : Interpolate(start, goal, SmoothStep(s));
}

RelaxationResult Relax(const RelaxationScene& scene,
                       const RelaxationOptions& options,
                       Simulator* simulator,
                       const RelaxationCallback& on_frame,
                       const StopPredicate& stop) {
  return Dressing(scene, options, simulator, on_frame, stop).Run();
}

}  // namespace invsim
