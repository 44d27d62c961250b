// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_FIT_BODY_INIT_H_
#define INVSIM_FIT_BODY_INIT_H_

// A first body for every frame from points alone, no cloth simulated (the
// paper's section 3.5, eq. 7).
//
//   1. Anchors. In a few frames, far apart, the body is started at the points'
//      centroid in several headings and arm poses, fitted coarse to fine (few
//      points, wide loss, trunk and limbs before hands and feet), and the best
//      start kept; then each limb alone is started in several poses, and what
//      is better kept. The best anchor is where tracking begins.
//   2. Tracking. Frame by frame outwards from it, each started from its
//      neighbour; a frame much worse than those before is also started
//      afresh.
//   3. Together. All frames with one shape and smoothness in time.
//   4. A Gaussian filter in time, on rotations.
//
// The garment says which skin is hidden (fit/body_points_term.h).

#include <functional>
#include <string>

#include "invsim/base/interrupt.h"
#include "invsim/cloth/garment.h"
#include "invsim/fit/body_points_term.h"
#include "invsim/fit/optimizer.h"

namespace invsim {

struct BodyInitOptions {
  BodyPointsOptions points;
  // Stronger than what is true of people: cloth hides the skin in the same way
  // in all frames, so the points say less about the shape than their number
  // promises (docs/accuracy.md has the measurement).
  PriorOptions priors = {.shape = 300, .pose = 10};
  int anchors = 3;
  int headings = 8;
  int coarse_points = 600;  // per frame, while searching and tracking
  int fine_points = 2500;   // per frame, in the end
  int iterations = 25;      // of the last stage
  double filter = 1;        // standard deviation, frames
};
void Describe(OptionTable* table, BodyInitOptions* options);

struct BodyInit {
  BodySequence body;
  int anchor = 0;               // the frame tracking began with
  OptimizerSummary refinement;  // of the last stage
  bool complete = true;  // false: a stop was asked for, this is what there was
};

// `clouds`: one per frame, metres, none empty. `note` is told what was done,
// and may answer false to stop early; so may `stop`, asked within every
// optimisation, and InterruptRequested(). Throws InputError if there is no
// frame, or if points and body cannot be of one size (wrong unit).
using InitObserver = std::function<bool(const std::string& what)>;
BodyInit InitializeBody(const BodyModel& body,
                        const Garment& garment,
                        const std::vector<Points>& clouds,
                        const BodyInitOptions& options,
                        std::uint64_t seed,
                        const InitObserver& note,
                        const StopPredicate& stop = {});

}  // namespace invsim

#endif  // INVSIM_FIT_BODY_INIT_H_
