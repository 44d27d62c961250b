// SPDX-License-Identifier: Apache-2.0
#include "invsim/base/timer.h"

namespace invsim {

void Timers::Add(std::string_view name, double seconds, std::int64_t calls) {
  // A handful of parts: a search beats a map.
  for (Part& part : parts_) {
    if (part.name != name) continue;
    part.seconds += seconds;
    part.calls += calls;
    return;
  }
  parts_.push_back({std::string(name), seconds, calls});
}

void Timers::Add(const Timers& other) {
  for (const Part& part : other.parts_)
    Add(part.name, part.seconds, part.calls);
}

double Timers::seconds(std::string_view name) const {
  for (const Part& part : parts_)
    if (part.name == name) return part.seconds;
  return 0;
}

}  // namespace invsim
