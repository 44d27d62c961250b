// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_BASE_TIMER_H_
#define INVSIM_BASE_TIMER_H_

// Where the time goes: wall-clock seconds by named part, added up over calls.
//
//   Timers timers;
//   {
//     ScopedTimer timer(&timers, "factorise");
//     ...
//   }
//   for (const Timers::Part& part : timers.parts()) ...
//
// A scope costs about a tenth of a microsecond. Timers belong to one thread;
// add those of several with `Add`.

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace invsim {

class Timers {
 public:
  struct Part {
    std::string name;
    double seconds = 0;
    std::int64_t calls = 0;
  };

  void Add(std::string_view name, double seconds, std::int64_t calls = 1);
  void Add(const Timers& other);

  // In the order of first use.
  const std::vector<Part>& parts() const { return parts_; }
  // 0 for a part never timed.
  double seconds(std::string_view name) const;

 private:
  std::vector<Part> parts_;
};

// Adds its lifetime to a part of `timers`; times nothing if that is null.
class ScopedTimer {
 public:
  // `name` must outlive the timer; a literal does.
  ScopedTimer(Timers* timers, std::string_view name)
      : timers_(timers), name_(name) {
    if (timers_) start_ = Clock::now();
  }
  ~ScopedTimer() {
    if (timers_) timers_->Add(name_, Seconds(Clock::now() - start_).count());
  }
  ScopedTimer(const ScopedTimer&) = delete;
  ScopedTimer& operator=(const ScopedTimer&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  using Seconds = std::chrono::duration<double>;

  Timers* timers_;
  std::string_view name_;
  Clock::time_point start_;
};

}  // namespace invsim

#endif  // INVSIM_BASE_TIMER_H_
