// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_APPS_SWEEP_RUNS_H_
#define INVSIM_APPS_SWEEP_RUNS_H_

// The runs of a sweep on disk:
//
//   DIR/runs/NAME/0/       the run folder of setting NAME, first repeat
//   DIR/runs/NAME/0.json   its arguments, exit code and times, once it is done
//   DIR/runs/NAME/0.log    what it printed
//
// A run that is done is not run again.

#include <string>
#include <vector>

#include "invsim/study/sweep.h"

namespace invsim {

struct SweepRun {
  int exit_code = -1;
  double wall_seconds = 0;
  double cpu_seconds = 0;
  bool usable() const { return exit_code == 0 || exit_code == 4; }
};

class SweepRuns {
 public:
  // `common`: arguments of every run, the command first.
  SweepRuns(const std::string& folder, std::vector<std::string> common);

  std::string Folder(const SweepSetting& setting, int repeat) const;

  // Whether it is done, with these very arguments. Throws UsageError if it was
  // done with others.
  bool Done(const SweepSetting& setting, int repeat) const;

  // Removes what is there of it.
  void Forget(const SweepSetting& setting, int repeat) const;

  // Runs it, unless it is done. Exit code 130 (interrupted) leaves it undone.
  SweepRun Run(const SweepSetting& setting, int repeat) const;

  // The result of a run that is done: median times, numbers of report.json,
  // errors left for the caller.
  SweepResult Result(const SweepSetting& setting,
                     int repeats,
                     const std::vector<std::string>& report_keys) const;

 private:
  std::vector<std::string> Arguments(const SweepSetting& setting,
                                     int repeat) const;
  std::string Path(const SweepSetting& setting,
                   int repeat,
                   const std::string& extension) const;

  std::string folder_;
  std::vector<std::string> common_;
};

}  // namespace invsim

#endif  // INVSIM_APPS_SWEEP_RUNS_H_
