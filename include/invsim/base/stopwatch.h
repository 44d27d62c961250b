// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_BASE_STOPWATCH_H_
#define INVSIM_BASE_STOPWATCH_H_

#include <chrono>

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

}  // namespace invsim

#endif  // INVSIM_BASE_STOPWATCH_H_
