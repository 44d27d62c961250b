// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SIM_ROLLOUT_H_
#define INVSIM_SIM_ROLLOUT_H_

// Cloth through many frames: a sequence of body positions goes in, the cloth
// at each frame comes out, with what it took to get there.

#include <functional>

#include "invsim/geometry/surface_index.h"
#include "invsim/sim/penetration.h"
#include "invsim/sim/simulator.h"

namespace invsim {

enum class RunStatus {
  kComplete,
  kFailed,       // the state became not finite; the last good one is kept
  kInterrupted,  // InterruptRequested(), at the end of a frame
};

struct FrameStats {
  StepStats step;
  double seconds = 0;  // of wall clock
  double processor_seconds = 0;
  double mean_speed = 0;  // of the cloth's vertices, m/s
  Penetration penetration;
  // Pairs of cloth faces that cross each other; looked for only in a scene with
  // self-contact, else -1.
  int crossing_pairs = -1;

  // Sums; of speed the last, of penetration and crossings the worst.
  void Add(const FrameStats& next);
};

// Mean over vertices of |v|, m/s.
double MeanSpeed(const ClothState& state);

// The cloth on a body whose position is given frame by frame.
class FrameStepper {
 public:
  // Neither `simulator` is owned nor is the state checked for penetration: a
  // vertex inside the body is led out of it.
  FrameStepper(Simulator* simulator, Points body, ClothState state);

  // The cloth while the body moves to `body` in `duration` seconds. False if
  // it failed; body and cloth then stay as they were.
  bool Step(Points body, double duration, FrameStats* stats);

  // Speed and penetration as the cloth is now; the rest zero.
  FrameStats Measure();

  // Takes share `kept` of the cloth's velocity, 1: all of it.
  void ScaleVelocity(double kept) { state_.v *= kept; }

  const Simulator& simulator() const { return *simulator_; }
  const Points& body() const { return body_; }
  const ClothState& state() const { return state_; }

 private:
  Simulator* simulator_;
  SurfaceIndex surface_;  // of the body, for measuring
  Points body_;
  ClothState state_;
};

// One frame done. Everything is valid during the call only.
struct SimulatedFrame {
  int frame;
  const Points& body;
  const ClothState& cloth;
  const Simulator& simulator;  // for contact_force() and BodyForce()
  const FrameStats& stats;
};
using FrameCallback = std::function<void(const SimulatedFrame&)>;

struct RolloutResult {
  RunStatus status = RunStatus::kComplete;
  int frames = 0;  // done, the first included
  FrameStats stats;
};

// `state` is the cloth at frame 0, on body(0); on return that of the last
// frame done. `on_frame` is called for frame 0, too, as it was given.
RolloutResult SimulateSequence(Simulator* simulator,
                               const std::function<Points(int)>& body,
                               int num_frames,
                               double frames_per_second,
                               ClothState* state,
                               const FrameCallback& on_frame = {});

}  // namespace invsim

#endif  // INVSIM_SIM_ROLLOUT_H_
