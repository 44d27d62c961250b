// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_TESTS_REPORT_FIT_ROUND_H_
#define INVSIM_TESTS_REPORT_FIT_ROUND_H_

#include "invsim/fit/sequence_fit.h"

namespace invsim {

// The round kept of a fit that has one.
inline FitRound& OnlyRound(FitResult* result) {
  result->rounds.resize(1);
  result->kept = 0;
  return result->rounds[0];
}

}  // namespace invsim

#endif  // INVSIM_TESTS_REPORT_FIT_ROUND_H_
