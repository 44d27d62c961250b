// SPDX-License-Identifier: Apache-2.0

// The invsim command: a list of subcommands.

#include "command.h"
#include "dispatcher.h"

int main(int argc, char** argv) {
  std::vector<std::unique_ptr<invsim::Command>> commands;
  commands.push_back(invsim::MakeCompareCommand());
  commands.push_back(invsim::MakeFitCommand());
  commands.push_back(invsim::MakeInitCommand());
  commands.push_back(invsim::MakeInspectCommand());
  commands.push_back(invsim::MakeListCommand());
  commands.push_back(invsim::MakeSimulateCommand());
  commands.push_back(invsim::MakeSynthCommand());
  return invsim::Dispatch(commands, argc, argv);
}
