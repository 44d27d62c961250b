// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_FIT_CLOTH_ROLLOUT_H_
#define INVSIM_FIT_CLOTH_ROLLOUT_H_

// The garment on a candidate body, frame by frame, with what the derivative
// of every frame needs.
//
// The cloth of frame 0 is led from a reference, cloth at rest on a reference
// body (sim/relaxation.h): that body goes straight to the wanted one in
// `lead_frames` and stands there for `hold_frames` with damped cloth. The
// cloth of frame 0 is then at rest by definition.
//
// What comes out depends on the bodies and the reference alone, not on what
// was simulated before.

#include <vector>

#include "invsim/sim/frame_record.h"
#include "invsim/sim/rollout.h"
#include "invsim/sim/simulator.h"

namespace invsim {

// Where the cloth of the first frame comes from.
struct ClothReference {
  Points body;       // 3 x V
  ClothState cloth;  // at rest on it
};

struct LeadOptions {
  int lead_frames = 4;
  int hold_frames = 4;
};
void Describe(OptionTable* table, LeadOptions* options);

class ClothRollout {
 public:
  // Share of its velocity the cloth keeps per frame while frame 0 is held.
  static constexpr double kKeptVelocity = 0.7;

  // `simulator` must outlive the rollout.
  ClothRollout(Simulator* simulator,
               const ClothReference& reference,
               int num_frames,
               double frames_per_second,
               const LeadOptions& options);

  int num_frames() const { return static_cast<int>(cloth_.size()); }
  const Simulator& simulator() const { return *simulator_; }
  const LeadOptions& options() const { return options_; }

  // The cloth at frame t on `body`, from that of frame t - 1, which must be
  // done. False if the simulation failed.
  bool Step(int t, const Points& body);

  const ClothState& cloth(int t) const { return cloth_[t]; }
  const std::vector<ClothState>& cloth() const { return cloth_; }
  // The simulated frame that ends at frame t.
  const FrameRecord& record(int t) const {
    return t == 0 ? lead_records_.back() : records_[t];
  }
  // All that lead to frame 0; the body stands still in the last hold_frames.
  const std::vector<FrameRecord>& lead_records() const { return lead_records_; }

  // Called after every step with contact forces and statistics; unset: none
  // are measured.
  void set_on_frame(FrameCallback on_frame) { on_frame_ = std::move(on_frame); }

  // From now on frame 0 is led from there.
  void set_reference(const ClothReference& reference) {
    reference_ = reference;
  }

  // Sums over all steps.
  const StepStats& stats() const { return stats_; }
  long frames_simulated() const { return frames_simulated_; }
  double seconds() const { return seconds_; }

 private:
  bool Lead(const Points& body, StepStats* stats);
  void Report(int t, const Points& body, const StepStats& step, double seconds);

  Simulator* simulator_;
  ClothReference reference_;
  LeadOptions options_;
  double dt_;
  std::vector<Points> bodies_;
  std::vector<ClothState> cloth_;
  std::vector<FrameRecord> records_, lead_records_;
  FrameCallback on_frame_;
  StepStats stats_;
  long frames_simulated_ = 0;
  double seconds_ = 0;
};

}  // namespace invsim

#endif  // INVSIM_FIT_CLOTH_ROLLOUT_H_
