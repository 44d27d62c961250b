// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_STUDY_CLOTHED_SEQUENCE_H_
#define INVSIM_STUDY_CLOTHED_SEQUENCE_H_

// A whole sequence with known truth on disk: a garment is simulated on a body
// over a motion, and what a scanner would see of it is measured.
//
//   SceneOptions physics;              // effects, contact, step
//   physics.contact.friction = material.friction;
//   ClothedSequenceOptions options;    // relaxation, measurement, seed
//   ClothedSequenceResult made = MakeClothedSequence(
//       {body, garment, material, motion, {.garment = "tshirt"}},
//       physics, options, "DIR", {});
//   if (made.status() != RunStatus::kComplete) ...   // nothing but the
//                                      // relaxation's and rollout's figures
//
// It leaves, in DIR:
//
//   points/%06d.ply    the measured points, 32-bit
//   garment.obj        as simulated: `v` placed, `vt` the rest shape
//   body_model.npz     the body (SMPL layout)
//   truth.npz          see study/truth.h
//   scene.json         frame rate, names, fabric, friction, noise, seed: what
//                      made the sequence and may be known of it
//   config.resolved.toml   `config`
//
// Files appear when the simulation has ended well; until then there is none.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "invsim/body/motion.h"
#include "invsim/sim/relaxation.h"
#include "invsim/sim/scene.h"
#include "invsim/study/measurement.h"

namespace invsim {

// As the user gave them, for scene.json.
struct ClothedSequenceNames {
  std::string body, motion, garment;
};

struct ClothedSequenceScene {
  const BodyModel& body;
  const Garment& garment;  // placed round the T-posed body of shape zero
  const Material& material;
  const Motion& motion;
  ClothedSequenceNames names = {};
};

struct ClothedSequenceOptions {
  RelaxationOptions relaxation;
  MeasurementOptions measurement;
  std::uint64_t seed = 0;
  std::string config = "";  // text of config.resolved.toml
  // Replace an earlier sequence in the directory, unless one of these paths
  // would be lost: what the sequence is made from (io/earlier_results.h).
  bool force = false;
  std::vector<std::string> inputs = {};
};

struct ClothedSequenceResult {
  RelaxationResult relaxation;
  RolloutResult sequence;
  RunStatus status() const {
    return relaxation.status == RunStatus::kComplete ? sequence.status
                                                     : relaxation.status;
  }
};

// Told after each frame what is going on ("dressing", "frames"), how far it
// is, and what the frame took.
using ClothedSequenceObserver = std::function<void(
    const char* what, int done, int total, const FrameStats& stats)>;

// Throws UsageError if there is something in the directory already (and not
// `force`, or something that is not ours to replace), InputError if it cannot
// be written or the inputs do not fit.
ClothedSequenceResult MakeClothedSequence(
    const ClothedSequenceScene& scene,
    const SceneOptions& physics,
    const ClothedSequenceOptions& options,
    const std::string& directory,
    const ClothedSequenceObserver& observer = {});

// Writes a garment so that ReadGarment gives it back: without `vt` if its rest
// shape is the placed one.
void WriteGarment(const std::string& path, const Garment& garment);

}  // namespace invsim

#endif  // INVSIM_STUDY_CLOTHED_SEQUENCE_H_
