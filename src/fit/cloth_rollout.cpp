// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/cloth_rollout.h"

#include <algorithm>

#include "invsim/base/options.h"
#include "invsim/base/stopwatch.h"

namespace invsim {

void Describe(OptionTable* table, LeadOptions* o) {
  table->Add(
      "lead_frames",
      &o->lead_frames,
      {.doc = "frames in which the first body is reached", .at_least = 1});
  table->Add("hold_frames",
             &o->hold_frames,
             {.doc = "frames it is then held", .at_least = 0});
}

ClothRollout::ClothRollout(Simulator* simulator,
                           const ClothReference& reference,
                           int num_frames,
                           double frames_per_second,
                           const LeadOptions& options)
    : simulator_(simulator),
      reference_(reference),
      options_(options),
      dt_(1 / frames_per_second),
      bodies_(num_frames),
      cloth_(num_frames),
      records_(num_frames),
      lead_records_(std::max(1, options.lead_frames) + options.hold_frames) {}

// From the reference to frame 0. The body's way is straight; it is short.
bool ClothRollout::Lead(const Points& target, StepStats* stats) {
  simulator_->Forget();
  simulator_->FindInside(reference_.body, reference_.cloth);
  ClothState state = reference_.cloth;
  const int moves = std::max(1, options_.lead_frames);
  Points before = reference_.body;
  for (size_t k = 0; k < lead_records_.size(); ++k) {
    const double s = std::min(1.0, (k + 1.0) / moves);
    const Points after = (1 - s) * reference_.body + s * target;
    if (!simulator_->Advance(
            before, after, dt_, &state, stats, &lead_records_[k]))
      return false;
    if (static_cast<int>(k) >= moves) state.v *= kKeptVelocity;
    before = after;
    ++frames_simulated_;
  }
  state.v.setZero();
  cloth_[0] = std::move(state);
  return true;
}

bool ClothRollout::Step(int t, const Points& body) {
  const Stopwatch watch;
  StepStats step;
  bool good = true;
  if (t == 0) {
    good = Lead(body, &step);
  } else {
    simulator_->FindInside(bodies_[t - 1], cloth_[t - 1]);
    cloth_[t] = cloth_[t - 1];
    good = simulator_->Advance(
        bodies_[t - 1], body, dt_, &cloth_[t], &step, &records_[t]);
    ++frames_simulated_;
  }
  bodies_[t] = body;
  stats_.Add(step);
  seconds_ += watch.seconds();
  if (good && on_frame_) Report(t, body, step, watch.seconds());
  return good;
}

void ClothRollout::Report(int t,
                          const Points& body,
                          const StepStats& step,
                          double seconds) {
  FrameStats stats;
  stats.step = step;
  stats.seconds = seconds;
  stats.mean_speed = MeanSpeed(cloth_[t]);
  stats.penetration = MeasurePenetration(
      SurfaceIndex(body, simulator_->body_faces()), cloth_[t].x);
  on_frame_({t, body, cloth_[t], *simulator_, stats});
}

}  // namespace invsim
