// SPDX-License-Identifier: Apache-2.0

// invsim gallery: hard cases of the simulator and of the fit, and whether they
// hold in them.

#include <unistd.h>

#include <iostream>
#include <optional>

#include "command.h"
#include "invsim/base/error.h"
#include "invsim/base/interrupt.h"
#include "invsim/base/progress.h"
#include "invsim/io/earlier_results.h"
#include "invsim/report/gallery_report.h"
#include "invsim/report/hard_map_report.h"
#include "invsim/report/run_folder.h"
#include "invsim/study/hard_fit.h"
#include "invsim/study/hard_map.h"
#include "invsim/study/hard_scene.h"

namespace invsim {
namespace {

std::vector<std::string> MapNames() {
  std::vector<std::string> names = {"none"};
  for (const HardMap& map : HardMaps()) names.push_back(map.name);
  return names;
}

struct GalleryOptions {
  std::string only;
  std::string map = "none";
  int every = 1;
  bool derivative = true;
};

void Describe(OptionTable* table, GalleryOptions* o) {
  table->Add("only",
             &o->only,
             {.doc = "run the cases whose name has this in it; empty: all"});
  table->Add("map",
             &o->map,
             {.doc = "instead of the cases: one scene over a grid of two of "
                     "its figures, to where it breaks",
              .choices = MapNames()});
  table->Add("every",
             &o->every,
             {.doc = "of a map: each row and column of so many, for a first "
                     "look",
              .at_least = 1});
  table->Add(
      "derivative",
      &o->derivative,
      {.doc = "also hold the derivative of a frame against differences"});
}

class GalleryCommand : public Command {
 public:
  std::string name() const override { return "gallery"; }
  std::string doc() const override {
    return "hard cases of simulator and fit, and whether they hold";
  }
  void AddArguments(CLI::App* app, KeyFlags* flags) override {
    flags->Add("--only", "gallery.only", "cases with this in their name");
    flags->Add("--map", "gallery.map", "a map of where a scene breaks");
    app->add_flag("--force", force_, "replace an earlier report in DIR");
  }
  void AddOptions(OptionTable* table) override {
    table->AddSection("gallery", &options_);
  }
  ExitCode Run(const CommandContext& context) override;

 private:
  ExitCode RunCases(const CommandContext& context, RunFolder* folder);
  ExitCode RunMap(const CommandContext& context, RunFolder* folder);
  // Those of `cases` that are asked for.
  template <typename Case>
  std::vector<const Case*> Chosen(const std::vector<Case>& cases) const {
    std::vector<const Case*> chosen;
    for (const Case& c : cases)
      if (c.name.find(options_.only) != std::string::npos) chosen.push_back(&c);
    return chosen;
  }

  GalleryOptions options_;
  bool force_ = false;
};

ExitCode GalleryCommand::RunCases(const CommandContext& context,
                                  RunFolder* folder) {
  const std::vector<const HardCase*> scenes = Chosen(HardCases());
  const std::vector<const HardFitCase*> fits = Chosen(HardFitCases());
  const int count = static_cast<int>(scenes.size() + fits.size());
  if (count == 0)
    throw UsageError("gallery.only: no case has '" + options_.only +
                     "' in its name; the first is " + HardCases()[0].name);
  GalleryReport report;
  report.derivative = options_.derivative;
  {
    Progress progress(context.verbosity < 0 ? nullptr : &std::cerr,
                      StyleFor(STDERR_FILENO),
                      "cases",
                      count);
    for (const HardCase* c : scenes) {
      if (InterruptRequested()) return ExitCode::kInterrupted;
      report.rows.push_back({*c, RunHardCase(*c, options_.derivative)});
      progress.Advance(c->name);
    }
    for (const HardFitCase* c : fits) {
      HardFitOutcome outcome = RunHardFitCase(*c);
      if (InterruptRequested()) return ExitCode::kInterrupted;
      report.fits.push_back({*c, std::move(outcome)});
      progress.Advance(c->name);
    }
  }
  if (folder) {
    folder->Write("report.json", GalleryJson(report));
    folder->Write("report.html", GalleryHtml(report));
  }
  std::cout << (context.json ? GalleryJson(report) : GalleryText(report));
  return Holds(report) ? ExitCode::kOk : ExitCode::kFailed;
}

ExitCode GalleryCommand::RunMap(const CommandContext& context,
                                RunFolder* folder) {
  HardMapReport report;
  for (const HardMap& map : HardMaps())
    if (map.name == options_.map) report.map = EveryNth(map, options_.every);
  const int columns = static_cast<int>(report.map.x.size());
  const int rows = static_cast<int>(report.map.y.size());
  {
    Progress progress(context.verbosity < 0 ? nullptr : &std::cerr,
                      StyleFor(STDERR_FILENO),
                      "cells",
                      rows * columns);
    for (int j = 0; j < rows; ++j) {
      report.cells.emplace_back();
      for (int i = 0; i < columns; ++i) {
        if (InterruptRequested()) return ExitCode::kInterrupted;
        report.cells.back().push_back(RunMapCell(report.map, i, j));
        progress.Advance();
      }
    }
  }
  if (folder) {
    folder->Write("report.json", HardMapJson(report));
    folder->Write(options_.map + ".svg", HardMapSvg(report));
  }
  std::cout << (context.json ? HardMapJson(report) : HardMapText(report));
  return ExitCode::kOk;
}

ExitCode GalleryCommand::Run(const CommandContext& context) {
  const InterruptGuard interrupt;
  std::optional<RunFolder> folder;
  if (!context.out.empty()) {
    folder.emplace(
        context.out, force_, std::vector<std::string>{context.config});
    folder->Write(kResolvedConfig, ResolvedToml(*context.options));
  }
  RunFolder* out = folder ? &*folder : nullptr;
  return options_.map == "none" ? RunCases(context, out) : RunMap(context, out);
}

}  // namespace

std::unique_ptr<Command> MakeGalleryCommand() {
  return std::make_unique<GalleryCommand>();
}

}  // namespace invsim
