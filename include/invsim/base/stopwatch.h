// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_BASE_STOPWATCH_H_
#define INVSIM_BASE_STOPWATCH_H_

#include <chrono>
#include <ctime>

namespace invsim {

// Wall-clock seconds since it was made.
class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

// Processor seconds of this process, all its threads, since it was made: what
// other processes do meanwhile is not in it.
class ProcessorStopwatch {
 public:
  double seconds() const { return Now() - start_; }

 private:
  static double Now() {
    timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * now.tv_nsec;
  }
  double start_ = Now();
};

}  // namespace invsim

#endif  // INVSIM_BASE_STOPWATCH_H_
