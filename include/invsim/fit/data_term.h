// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_FIT_DATA_TERM_H_
#define INVSIM_FIT_DATA_TERM_H_

// What the measured points say about the unknowns: the part of the objective
// that is expensive. It is evaluated for the whole sequence at once, first its
// cost and, where that point is kept, its linearisation there.

#include <limits>
#include <string>
#include <vector>

#include "invsim/fit/body_sequence.h"
#include "invsim/fit/frame_block.h"

namespace invsim {

enum class Evaluation {
  kDone,
  kAbandoned,  // the cost is above the limit
  kFailed,     // cannot be evaluated here
  kStopped     // a stop was asked for; says nothing about the point
};

// The cost limit of an evaluation that shall not be given up.
inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

class DataTerm {
 public:
  virtual ~DataTerm() = default;
  virtual int num_frames() const = 0;

  // The cost of every frame at x. May give up once their sum exceeds
  // `cost_limit`: whatever follows, the point is then worse.
  virtual Evaluation Evaluate(const BodySequence& x,
                              double cost_limit,
                              std::vector<double>* costs) = 0;

  // The frames' blocks, by (beta, theta_t, t_t), at the point evaluated last.
  // False if a derivative does not exist there, or is not finite.
  virtual bool Linearize(std::vector<FrameBlock>* blocks) = 0;
};

}  // namespace invsim

#endif  // INVSIM_FIT_DATA_TERM_H_
