// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_APPS_SWEEP_RUNS_H_
#define INVSIM_APPS_SWEEP_RUNS_H_

// The runs of a sweep on disk: DIR/runs/NAME/0 is the first repeat of setting
// NAME, with its record and log beside it (recorded_run.h).

#include <string>
#include <vector>

#include "invsim/study/sweep.h"
#include "recorded_run.h"

namespace invsim {

class SweepRuns {
 public:
  // `common`: arguments of every run, the command first.
  SweepRuns(std::string folder, std::vector<std::string> common);

  RecordedRun At(const SweepSetting& setting, int repeat) const;

  // The result of a run that is done: median times, numbers of report.json,
  // errors left for the caller.
  SweepResult Result(const SweepSetting& setting,
                     int repeats,
                     const std::vector<std::string>& report_keys) const;

 private:
  std::string folder_;
  std::vector<std::string> common_;
};

}  // namespace invsim

#endif  // INVSIM_APPS_SWEEP_RUNS_H_
