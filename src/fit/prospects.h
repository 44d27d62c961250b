// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_FIT_PROSPECTS_H_
#define INVSIM_SRC_FIT_PROSPECTS_H_

// Whether an optimisation may still end below a cost that is to be beaten,
// told by its first step that helped: c_0 to c_1 with all steps after it
// expected to gain no more than it did, the end is not below 2 c_1 - c_0
// (docs/accuracy.md has what fits gained).

#include <sstream>
#include <string>

#include "invsim/fit/optimizer.h"

namespace invsim {

class Prospects {
 public:
  // `kept`: the cost to beat; infinite: nothing is ever given up.
  explicit Prospects(double kept) : kept_(kept) {}
  bool good() const { return good_; }
  void Update(const IterationRecord& record) {
    if (record.iteration == 0) start_ = record.cost;
    if (judged_ || record.cost >= start_) return;
    judged_ = true;
    good_ = record.cost - (start_ - record.cost) < kept_;
  }
  std::string reason() const {
    std::ostringstream text;
    text << "Its first step did not come near the cost of what is kept, "
         << kept_ << ".";
    return text.str();
  }

 private:
  double kept_, start_ = 0;
  bool judged_ = false, good_ = true;
};

}  // namespace invsim

#endif  // INVSIM_SRC_FIT_PROSPECTS_H_
