// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_FIT_FIT_CHECKPOINT_H_
#define INVSIM_FIT_FIT_CHECKPOINT_H_

// The files in which a fit leaves what it has (sequence_fit.h):
//
//   inputs.txt         digests of what the fit is made from, by name
//   start.npz          the body of stage 1, AMASS layout
//   reference_K.npz    body (V,3), x and v (N,3): the cloth at rest of stage 2,
//                      dressed for the K-th time
//   evaluations_K.bin  the evaluations of stage 3 (remembered_term.h) from
//                      there
//
// A file is there whole or not at all; evaluations are there up to the last
// whole record.

#include <optional>
#include <string>

#include "invsim/fit/body_sequence.h"
#include "invsim/fit/cloth_rollout.h"
#include "invsim/fit/input_digests.h"

namespace invsim {

class FitCheckpoint {
 public:
  // "": nothing is kept, nothing found. Otherwise an existing folder.
  explicit FitCheckpoint(const std::string& folder) : folder_(folder) {}

  bool kept() const { return !folder_.empty(); }
  std::string Evaluations(int dressing) const;

  // Whether there is something to go on from.
  bool HasStart() const;
  // Notes what a new fit is made from. Of one that goes on: throws InputError,
  // naming what is another now, if it was made from something else.
  void Open(const InputDigests& inputs) const;

  // Nothing if it is not there, or was dressed on another body than `body`
  // (after more iterations there is another). Throws InputError if it is
  // damaged or of another sequence.
  std::optional<BodySequence> LoadStart(int num_frames) const;
  std::optional<ClothReference> LoadReference(int dressing,
                                              const Points& body,
                                              int cloth_vertices) const;
  // Throw InputError if a file cannot be written. What was evaluated from an
  // earlier reference of that dressing is removed.
  void Save(const BodySequence& start) const;
  void Save(int dressing, const ClothReference& reference) const;

 private:
  std::string Reference(int dressing) const;

  std::string folder_;
};

}  // namespace invsim

#endif  // INVSIM_FIT_FIT_CHECKPOINT_H_
