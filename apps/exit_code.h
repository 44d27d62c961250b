// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_APPS_EXIT_CODE_H_
#define INVSIM_APPS_EXIT_CODE_H_

#include <algorithm>
#include <iterator>

#include "invsim/fit/optimizer.h"

namespace invsim {

// What the process tells the one that started it.
enum class ExitCode {
  kOk = 0,             // converged, or done, and usable
  kInternal = 1,       // a bug
  kUsage = 2,          // command line or configuration
  kInput = 3,          // bad input data
  kStoppedEarly = 4,   // iterations or time ran out; usable
  kFailed = 5,         // failed or unusable
  kStalled = 6,        // stalled where the simulation fails
  kInterrupted = 130,  // stopped by a signal, checkpoint written
};

// Of a fit that ended so.
inline ExitCode CodeOf(Termination termination) {
  switch (termination) {
    case Termination::kConverged:
      return ExitCode::kOk;
    case Termination::kIterationLimit:
    case Termination::kTimeLimit:
    case Termination::kGivenUp:
      return ExitCode::kStoppedEarly;
    case Termination::kInterrupted:
      return ExitCode::kInterrupted;
    case Termination::kStalled:
      return ExitCode::kStalled;
    case Termination::kFailed:
      break;
  }
  return ExitCode::kFailed;
}

// Of two fits the code that says less good.
inline ExitCode Worse(ExitCode a, ExitCode b) {
  constexpr ExitCode kFromBest[] = {ExitCode::kOk,
                                    ExitCode::kStoppedEarly,
                                    ExitCode::kStalled,
                                    ExitCode::kFailed,
                                    ExitCode::kInterrupted};
  const auto rank = [&](ExitCode code) {
    return std::find(std::begin(kFromBest), std::end(kFromBest), code);
  };
  return rank(a) < rank(b) ? b : a;
}

}  // namespace invsim

#endif  // INVSIM_APPS_EXIT_CODE_H_
