// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_APPS_EXIT_CODE_H_
#define INVSIM_APPS_EXIT_CODE_H_

namespace invsim {

enum class Termination;

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
ExitCode CodeOf(Termination termination);

// Of two fits the code that says less good.
ExitCode Worse(ExitCode a, ExitCode b);

}  // namespace invsim

#endif  // INVSIM_APPS_EXIT_CODE_H_
