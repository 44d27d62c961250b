// SPDX-License-Identifier: Apache-2.0

// The list of subcommands.

#include "command.h"

namespace invsim {

std::vector<std::unique_ptr<Command>> AllCommands() {
  std::vector<std::unique_ptr<Command>> commands;
  commands.push_back(MakeCheckGradientCommand());
  commands.push_back(MakeCompareCommand());
  commands.push_back(MakeDemoCommand());
  commands.push_back(MakeEvalCommand());
  commands.push_back(MakeFitCommand());
  commands.push_back(MakeGalleryCommand());
  commands.push_back(MakeInitCommand());
  commands.push_back(MakeInspectCommand());
  commands.push_back(MakeListCommand());
  commands.push_back(MakeReportCommand());
  commands.push_back(MakeSimulateCommand());
  commands.push_back(MakeSoakCommand());
  commands.push_back(MakeSweepCommand());
  commands.push_back(MakeSynthCommand());
  return commands;
}

}  // namespace invsim
