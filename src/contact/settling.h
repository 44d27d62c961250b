// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_CONTACT_SETTLING_H_
#define INVSIM_SRC_CONTACT_SETTLING_H_

// Watches an iteration settle: whether the contacts' modes still change, and
// how fast the residual falls.

#include <vector>

#include "invsim/contact/coulomb.h"

namespace invsim {

class Settling {
 public:
  void Add(double residual, const std::vector<ContactMode>& modes);

  // Next to no contact changed its mode of late, and there were enough
  // iterations to tell.
  bool ModesRest() const;

  // Iterations yet to come until the residual is `tolerance`, at the mean rate
  // of the last ones; infinite if it does not fall, or if there were too few.
  double IterationsLeft(double tolerance) const;

 private:
  std::vector<double> log_residual_;
  std::vector<ContactMode> modes_;
  int resting_ = 0;  // iterations
};

}  // namespace invsim

#endif  // INVSIM_SRC_CONTACT_SETTLING_H_
