// SPDX-License-Identifier: Apache-2.0
#include "invsim/sim/rollout.h"

#include <algorithm>
#include <utility>

#include "invsim/base/interrupt.h"
#include "invsim/base/stopwatch.h"
#include "invsim/geometry/self_intersection.h"

namespace invsim {

void FrameStats::Add(const FrameStats& next) {
  step.Add(next.step);
  seconds += next.seconds;
  processor_seconds += next.processor_seconds;
  mean_speed = next.mean_speed;
  penetration.KeepWorst(next.penetration);
  crossing_pairs = std::max(crossing_pairs, next.crossing_pairs);
}

double MeanSpeed(const ClothState& state) {
  return state.v.cols() > 0 ? state.v.colwise().norm().mean() : 0.0;
}

FrameStepper::FrameStepper(Simulator* simulator, Points body, ClothState state)
    : simulator_(simulator),
      surface_(body, simulator->body_faces()),
      body_(std::move(body)),
      state_(std::move(state)) {}

bool FrameStepper::Step(Points body, double duration, FrameStats* stats) {
  const Stopwatch watch;
  const ProcessorStopwatch processor;
  // The simulator keeps track of sides by itself; asked once a frame, it also
  // notices what slipped past it, as where skin crosses skin.
  simulator_->FindInside(body_, state_);
  FrameStats own;
  if (!simulator_->Advance(body_, body, duration, &state_, &own.step)) {
    stats->step.Add(own.step);
    return false;
  }
  body_ = std::move(body);
  own.seconds = watch.seconds();
  own.processor_seconds = processor.seconds();
  const FrameStats now = Measure();
  own.mean_speed = now.mean_speed;
  own.penetration = now.penetration;
  own.crossing_pairs = now.crossing_pairs;
  stats->Add(own);
  return true;
}

FrameStats FrameStepper::Measure() {
  FrameStats now;
  now.mean_speed = MeanSpeed(state_);
  surface_.Update(body_);
  now.penetration = MeasurePenetration(surface_, state_.x);
  if (simulator_->self_contact_options())
    now.crossing_pairs = static_cast<int>(
        SelfIntersections(state_.x, simulator_->faces()).size());
  return now;
}

RolloutResult SimulateSequence(Simulator* simulator,
                               const std::function<Points(int)>& body,
                               int num_frames,
                               double frames_per_second,
                               ClothState* state,
                               const FrameCallback& on_frame) {
  RolloutResult result;
  if (num_frames <= 0) return result;
  FrameStepper stepper(simulator, body(0), *state);
  const auto report = [&](int frame, const FrameStats& stats) {
    result.stats.Add(stats);
    ++result.frames;
    if (on_frame)
      on_frame({frame, stepper.body(), stepper.state(), *simulator, stats});
  };
  report(0, stepper.Measure());
  for (int frame = 1; frame < num_frames; ++frame) {
    if (InterruptRequested()) {
      result.status = RunStatus::kInterrupted;
      break;
    }
    FrameStats stats;
    if (!stepper.Step(body(frame), 1.0 / frames_per_second, &stats)) {
      result.stats.step.Add(stats.step);
      result.status = RunStatus::kFailed;
      break;
    }
    report(frame, stats);
  }
  *state = stepper.state();
  return result;
}

}  // namespace invsim
