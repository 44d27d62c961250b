// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_REPORT_SWEEP_REPORT_PARTS_H_
#define INVSIM_SRC_REPORT_SWEEP_REPORT_PARTS_H_

// What the tables, the chart and the page of a sweep have in common.

#include "invsim/report/sweep_report.h"

namespace invsim {

// By cost, those without a result at the end.
std::vector<const SweepResult*> CheapestFirst(const SweepReport& report);

// "key = value" of all options.
std::string OptionsOf(const SweepSetting& setting, const char* separator);

// Of all results, in the order in which they first appear.
std::vector<std::string> ValueKeys(const SweepReport& report);

// Null if the result has no such value.
const double* Find(const SweepResult& result, const std::string& key);

// The verdict on the report's own results (study/sweep.h).
std::string VerdictOf(const SweepReport& report);

}  // namespace invsim

#endif  // INVSIM_SRC_REPORT_SWEEP_REPORT_PARTS_H_
