// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_STUDY_DISTURBANCE_H_
#define INVSIM_STUDY_DISTURBANCE_H_

// A known body made wrong, as a start from which a fit has to find it back.

#include <cstdint>

#include "invsim/base/options.h"
#include "invsim/fit/body_sequence.h"

namespace invsim {

struct DisturbanceOptions {
  // Every joint is turned about a random axis, alike in all frames, by an
  // angle of this root mean square.
  double turn = 0.1;  // rad
  // The body is moved in a random direction by this much.
  double shift = 0.03;  // m
  // The shape is taken away: 1, all of it.
  double shape = 1;
};
void Describe(OptionTable* table, DisturbanceOptions* options);

BodySequence Disturb(const BodySequence& truth,
                     const DisturbanceOptions& options,
                     std::uint64_t seed);

}  // namespace invsim

#endif  // INVSIM_STUDY_DISTURBANCE_H_
