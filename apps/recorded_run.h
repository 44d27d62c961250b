// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_APPS_RECORDED_RUN_H_
#define INVSIM_APPS_RECORDED_RUN_H_

// `invsim` run once as another process, with a record of how it went, so that
// it need not be run again:
//
//   PATH/       what it left
//   PATH.json   its arguments, exit code and times, once it is done
//   PATH.log    the command, and what it printed
//
// What of these names is not of an earlier run is never replaced.

#include <string>
#include <vector>

namespace invsim {

struct RunOutcome {
  int exit_code = -1;
  double wall_seconds = 0;
  double cpu_seconds = 0;
  bool usable() const { return exit_code == 0 || exit_code == 4; }
};

class RecordedRun {
 public:
  // `arguments`: all but --out PATH, the command first.
  RecordedRun(std::string path, std::vector<std::string> arguments);

  const std::string& folder() const { return path_; }

  // Runs it, unless it is done. Exit code 130 (interrupted) leaves it undone.
  // Throws UsageError if it was done with other arguments, or if there is
  // something of these names that is no record or log.
  RunOutcome Run() const;

  // Forgets that it was done; it will replace what it left.
  void Forget() const;
  // The same if somebody ended it by a signal: that is no result.
  void ForgetIfKilled() const;

  // The result, or why it failed: the signal that ended it, or of what it
  // printed the last line that is not the folder's name.
  std::string LastLine() const;

 private:
  std::string path_;
  std::vector<std::string> arguments_;
};

}  // namespace invsim

#endif  // INVSIM_APPS_RECORDED_RUN_H_
