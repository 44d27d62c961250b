// SPDX-License-Identifier: Apache-2.0
#include "exit_code.h"

#include <algorithm>

#include "invsim/fit/optimizer.h"

namespace invsim {

ExitCode CodeOf(Termination termination) {
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

ExitCode Worse(ExitCode a, ExitCode b) {
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
