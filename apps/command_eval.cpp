// SPDX-License-Identifier: Apache-2.0

// invsim eval: how far a run, or a folder of runs, is from the truth.

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <vector>

#include "command.h"
#include "evaluation_inputs.h"
#include "invsim/base/error.h"
#include "invsim/base/logging.h"
#include "invsim/base/progress.h"
#include "invsim/io/file.h"
#include "invsim/report/evaluation_report.h"

namespace invsim {
namespace {

namespace fs = std::filesystem;

constexpr char kBodyFile[] = "body.npz";

// Folders in `folder` that hold a run, by name.
std::vector<fs::path> RunsIn(const fs::path& folder) {
  std::vector<fs::path> runs, others;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (fs::exists(entry.path() / kBodyFile))
      runs.push_back(entry.path());
    else if (entry.is_directory())
      others.push_back(entry.path());
  }
  if (runs.empty())
    throw InputError(folder.string() +
                     ": neither it nor a folder in it holds a " + kBodyFile +
                     ", as runs do");
  for (const fs::path& other : others)
    LOG(WARNING) << other.string() << ": left out, holds no " << kBodyFile;
  std::sort(runs.begin(), runs.end());
  return runs;
}

class EvalCommand : public Command {
 public:
  std::string name() const override { return "eval"; }
  std::string doc() const override {
    return "how far a run is from the truth; a table for a folder of runs";
  }
  void AddArguments(CLI::App* app, KeyFlags*) override {
    app->add_option("--run", run_, "a run's folder, or a folder of runs")
        ->option_text("DIR")
        ->required();
    app->add_option("--truth",
                    truth_,
                    "a sequence's folder or truth.npz; for a folder of runs "
                    "also the folder of sequences of the same names")
        ->option_text("PATH")
        ->required();
    app->add_option("--body",
                    body_,
                    "mannequin or an SMPL-layout npz, if the truth has none "
                    "beside it")
        ->option_text("BODY");
    app->add_flag("--force", force_, "replace an earlier evaluation in DIR");
  }
  void AddOptions(OptionTable*) override {}
  ExitCode Run(const CommandContext& context) override;

 private:
  void PrepareFolder(const fs::path& out) const;
  RunEvaluation EvaluateRun(const std::string& run,
                            const std::string& truth,
                            std::ostream* log) const;
  std::vector<RunEvaluation> EvaluateAll(const std::vector<fs::path>& runs,
                                         std::ostream* log) const;
  void PrintOne(const RunEvaluation& e, const CommandContext& context) const;
  void PrintAll(const std::vector<RunEvaluation>& all,
                const CommandContext& context) const;

  std::string run_, truth_, body_;
  bool force_ = false;
};

RunEvaluation EvalCommand::EvaluateRun(const std::string& run,
                                       const std::string& truth,
                                       std::ostream* log) const {
  const LoadedReference loaded = LoadReference(truth, body_);
  RunEvaluation e{run, truth, loaded.garment, {}};
  if (e.garment.empty()) e.garment = fs::path(truth).filename().string();
  Progress progress(log,
                    StyleFor(STDERR_FILENO),
                    fs::path(run).filename().string(),
                    loaded.reference->truth.body.num_frames());
  try {
    e.metrics = Evaluate(
        *loaded.reference, LoadEstimate(run), [&](int) { progress.Advance(); });
  } catch (const InputError& error) {
    const std::string what = error.what();
    throw InputError(what.find(run) == 0 ? what : run + ": " + what);
  }
  return e;
}

// One that cannot be evaluated does not keep the others from being so; it is
// an error if none can.
std::vector<RunEvaluation> EvalCommand::EvaluateAll(
    const std::vector<fs::path>& runs, std::ostream* log) const {
  std::vector<RunEvaluation> all;
  std::vector<InputError> errors;
  for (const fs::path& run : runs) {
    const fs::path own = fs::path(truth_) / run.filename();
    try {
      all.push_back(EvaluateRun(
          run.string(), fs::is_directory(own) ? own.string() : truth_, log));
    } catch (const InputError& error) {
      errors.push_back(error);
    }
  }
  if (all.empty()) throw errors.front();
  for (const InputError& error : errors)
    LOG(ERROR) << error.what() << "; left out";
  return all;
}

void EvalCommand::PrintOne(const RunEvaluation& e,
                           const CommandContext& context) const {
  std::cout << (context.json ? EvaluationJson(e) : EvaluationText(e));
  if (context.out.empty()) return;
  const fs::path folder(context.out);
  WriteFileBytes((folder / "evaluation.json").string(), EvaluationJson(e));
  WriteFileBytes((folder / "report.html").string(), EvaluationPage(e));
}

void EvalCommand::PrintAll(const std::vector<RunEvaluation>& all,
                           const CommandContext& context) const {
  std::cout << (context.json ? EvaluationsJson(all) : ResultsTable(all));
  if (context.out.empty()) return;
  const fs::path folder(context.out);
  WriteFileBytes((folder / "evaluation.json").string(), EvaluationsJson(all));
  WriteFileBytes((folder / "evaluation.csv").string(), EvaluationsCsv(all));
  WriteFileBytes((folder / "table.md").string(), ResultsTable(all));
  WriteFileBytes((folder / "report.html").string(), EvaluationsPage(all));
}

// Replaces an earlier evaluation if asked to, but not what looks like one.
void EvalCommand::PrepareFolder(const fs::path& out) const {
  std::error_code failed;
  fs::create_directories(out, failed);
  const bool ours = fs::exists(out / "evaluation.json");
  for (const char* file :
       {"evaluation.json", "evaluation.csv", "table.md", "report.html"})
    if (fs::exists(out / file) && !(force_ && ours))
      throw UsageError(
          out.string() +
          (ours ? ": holds an evaluation already; choose another --out, or "
                  "--force to replace it"
                : ": holds a " + std::string(file) +
                      " of something else; choose another --out"));
}

ExitCode EvalCommand::Run(const CommandContext& context) {
  for (const std::string& path : {run_, truth_})
    if (!fs::exists(path)) throw InputError(path + ": does not exist");
  if (!fs::is_directory(run_))
    throw InputError(run_ + ": is a file, expected a run's folder");
  if (!context.out.empty()) PrepareFolder(context.out);
  std::ostream* log = context.verbosity > 0 ? &std::cerr : nullptr;
  if (fs::exists(fs::path(run_) / kBodyFile)) {
    PrintOne(EvaluateRun(run_, truth_, log), context);
    return ExitCode::kOk;
  }
  const std::vector<fs::path> runs = RunsIn(run_);
  const std::vector<RunEvaluation> all = EvaluateAll(runs, log);
  PrintAll(all, context);
  return all.size() == runs.size() ? ExitCode::kOk : ExitCode::kInput;
}

}  // namespace

std::unique_ptr<Command> MakeEvalCommand() {
  return std::make_unique<EvalCommand>();
}

}  // namespace invsim
