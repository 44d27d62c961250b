// SPDX-License-Identifier: Apache-2.0
#include "invsim/base/interrupt.h"

#include <signal.h>

#include <atomic>

namespace invsim {
namespace {

std::atomic<bool> requested = false;
static_assert(std::atomic<bool>::is_always_lock_free,
              "a signal handler may only touch lock-free atomics");

struct sigaction old_interrupt;
struct sigaction old_terminate;

void Handle(int) { requested = true; }

}  // namespace

InterruptGuard::InterruptGuard() {
  requested = false;
  struct sigaction action = {};
  action.sa_handler = Handle;
  sigemptyset(&action.sa_mask);
  // Handle once, then fall back to the default, which ends the process;
  // reads and writes under way go on.
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigaction(SIGINT, &action, &old_interrupt);
  sigaction(SIGTERM, &action, &old_terminate);
}

InterruptGuard::~InterruptGuard() {
  sigaction(SIGINT, &old_interrupt, nullptr);
  sigaction(SIGTERM, &old_terminate, nullptr);
}

bool InterruptRequested() { return requested; }

bool StopRequested(const StopPredicate& stop) {
  return InterruptRequested() || (stop && stop());
}

}  // namespace invsim
