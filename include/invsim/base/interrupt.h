// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_BASE_INTERRUPT_H_
#define INVSIM_BASE_INTERRUPT_H_

// Stopping on request: SIGINT (control-C) or SIGTERM (a scheduler's notice)
// raises a flag that long work looks at between steps, to write a checkpoint
// and end in order. The same signal again ends the process at once.

#include <functional>

namespace invsim {

// While one lives, the two signals raise the flag. One at a time.
class InterruptGuard {
 public:
  // Lowers the flag.
  InterruptGuard();
  // Gives the signals back to whoever had them.
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
};

// Whether a stop was asked for since the last guard was made.
bool InterruptRequested();

// What long work is given to ask, at the same places, whether its caller has
// had enough of it (a time limit). Once true it stays true. Empty: never.
using StopPredicate = std::function<bool()>;

// Whether a stop was asked for either way.
bool StopRequested(const StopPredicate& stop);

}  // namespace invsim

#endif  // INVSIM_BASE_INTERRUPT_H_
