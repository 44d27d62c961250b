// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_REPORT_FIT_REPORT_PARTS_H_
#define INVSIM_SRC_REPORT_FIT_REPORT_PARTS_H_

// What the fit's report says in more than one form.

#include <string>
#include <vector>

#include "invsim/report/fit_report.h"

namespace invsim {

// All frames of the final simulation together.
FrameStats Simulated(const FitReport& report);

// Joints that are undetermined in most frames.
std::vector<int> UndeterminedJoints(const Uncertainty& u);

}  // namespace invsim

#endif  // INVSIM_SRC_REPORT_FIT_REPORT_PARTS_H_
