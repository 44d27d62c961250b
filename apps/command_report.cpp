// SPDX-License-Identifier: Apache-2.0

// invsim report: runs side by side, from what they left in their folders.

#include <iostream>
#include <string>
#include <vector>

#include "command.h"
#include "invsim/report/run_summary.h"

namespace invsim {
namespace {

class ReportCommand : public Command {
 public:
  std::string name() const override { return "report"; }
  std::string doc() const override {
    return "how runs ended, side by side, and in which settings they differ";
  }
  void AddArguments(CLI::App* app, KeyFlags*) override {
    app->add_option("RUN", folders_, "folders of fits and simulations")
        ->required();
  }
  void AddOptions(OptionTable*) override {}

  ExitCode Run(const CommandContext& context) override {
    std::vector<RunSummary> runs;
    for (const std::string& folder : folders_)
      runs.push_back(ReadRunSummary(folder));
    std::cout << (context.json ? SummaryJson(runs) : SummaryText(runs));
    return ExitCode::kOk;
  }

 private:
  std::vector<std::string> folders_;
};

}  // namespace

std::unique_ptr<Command> MakeReportCommand() {
  return std::make_unique<ReportCommand>();
}

}  // namespace invsim
