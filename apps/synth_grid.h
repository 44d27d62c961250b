// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_APPS_SYNTH_GRID_H_
#define INVSIM_APPS_SYNTH_GRID_H_

// Sequences of every combination of some options, garments and motions above
// all, as in the paper's section 4.2: OUT/GARMENT_MOTION for each. Options of
// all of them stand as in any configuration, those to combine under [grid]:
//
//   [grid]
//   synth.garment = ["tshirt", "dress"]
//   synth.motion = ["walk_in_place", "turn"]

#include <functional>
#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

#include "exit_code.h"
#include "invsim/base/config.h"

namespace invsim {

class SynthGrid {
 public:
  // Takes [grid] out of `config`; what is left is for every sequence. `check`
  // is told the options of each. Throws UsageError if there is none, or two
  // sequences have the same name.
  void TakeConfig(Config* config,
                  const std::function<void(const Config&)>& check);

  // Makes those that are not there yet, writing a line for each to `results`
  // and progress to `log` unless it is null. One that fails does not keep the
  // others from being made.
  ExitCode Run(const std::string& out,
               bool force,
               std::ostream* results,
               std::ostream* log) const;

 private:
  // A name and arguments of `invsim`.
  std::vector<std::pair<std::string, std::vector<std::string>>> sequences_;
};

}  // namespace invsim

#endif  // INVSIM_APPS_SYNTH_GRID_H_
