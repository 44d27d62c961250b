// SPDX-License-Identifier: Apache-2.0

// invsim check-gradient: d(cloth)/d(shape, pose, translation) of one frame
// against central differences.

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "command.h"
#include "effects.h"
#include "invsim/base/error.h"
#include "invsim/base/interrupt.h"
#include "invsim/report/run_folder.h"
#include "invsim/sim/relaxation.h"
#include "invsim/sim/scene.h"
#include "invsim/study/gradient_check.h"
#include "simulation_input.h"

namespace invsim {
namespace {

using Json = nlohmann::ordered_json;

// Coarse cloth: the check simulates its frame some hundred times.
constexpr double kCoarseEdge = 0.06;

struct CheckOptions {
  int frame = 3;
  double contact_tolerance = 1e-10;
  double largest_error = 1e-6;
  GradientCheckOptions differences;
};

void Describe(OptionTable* table, CheckOptions* o) {
  table->Add("frame",
             &o->frame,
             {.doc = "of the motion: the one that is differentiated, after "
                     "those before it were simulated",
              .at_least = 1});
  table->Add("contact_tolerance",
             &o->contact_tolerance,
             {.doc = "of the frame; rounding of the differences",
              .unit = "vertex weights",
              .above = 0});
  table->Add("largest_error",
             &o->largest_error,
             {.doc = "relative error of a column whose contacts stay as they "
                     "are that passes",
              .above = 0});
  Describe(table, &o->differences);
}

struct Worst {
  const char* name;
  int first, last;  // of the parameters
};
constexpr Worst kGroups[] = {
    {"shape", 0, kNumShape},
    {"pose", kNumShape, kNumShape + kNumPose},
    {"translation", kNumShape + kNumPose, kNumBodyParameters}};

struct GroupSummary {
  int columns = 0, switched = 0;
  double worst = 0, worst_switched = 0;
};

GroupSummary Summarise(const GradientCheck& check, int first, int last) {
  GroupSummary group;
  for (const GradientColumn& c : check.columns) {
    if (c.parameter < first || c.parameter >= last) continue;
    ++group.columns;
    group.switched += c.switched;
    double* worst = c.switched ? &group.worst_switched : &group.worst;
    *worst = std::max(*worst, c.error);
  }
  return group;
}

// The bottom of the V-curve.
size_t BestStep(const GradientCheck& check) {
  return std::min_element(check.median_error.begin(),
                          check.median_error.end()) -
         check.median_error.begin();
}

void Print(const char* format, auto... values) {
  char line[200];
  std::snprintf(line, sizeof(line), format, values...);
  std::cout << line;
}

void PrintTable(const GradientCheck& check, int contacts) {
  Print("%-12s %8s %14s %9s %20s\n",
        "parameters",
        "columns",
        "largest error",
        "switched",
        "largest of those");
  const auto row = [](const char* name, const GroupSummary& g) {
    Print("%-12s %8d %14.1e %9d %20.1e\n",
          name,
          g.columns,
          g.worst,
          g.switched,
          g.worst_switched);
  };
  for (const Worst& group : kGroups)
    row(group.name, Summarise(check, group.first, group.last));
  row("all", Summarise(check, 0, kNumBodyParameters));
  Print("\n%-12s %14s\n", "step", "median error");
  for (size_t k = 0; k < check.steps.size(); ++k)
    Print("%-12.0e %14.1e%s\n",
          check.steps[k],
          check.median_error[k],
          k == BestStep(check) ? "  smallest" : "");
  Print("\n%d contacts; %d parameters do not move the cloth\n",
        contacts,
        check.still);
  if (check.compared() == 0)
    Print(
        "no column could be compared: expected a frame in which contacts "
        "hold the cloth to the body\n");
}

Json ToJson(const GradientCheck& check, int contacts) {
  Json json;
  json["schema"] = "invsim.gradient_check";
  json["schema_version"] = 1;
  json["contacts"] = contacts;
  json["columns"] = check.columns.size();
  json["columns_compared"] = check.compared();
  json["columns_without_influence"] = check.still;
  json["columns_switched"] = check.switched;
  json["largest_relative_error"] = check.worst;
  json["largest_relative_error_switched"] = check.worst_switched;
  json["best_step"] = check.steps[BestStep(check)];
  for (size_t k = 0; k < check.steps.size(); ++k)
    json["sweep"].push_back({{"step", check.steps[k]},
                             {"median_relative_error", check.median_error[k]}});
  for (const GradientColumn& c : check.columns)
    json["parameters"].push_back({{"parameter", c.parameter},
                                  {"norm", c.norm},
                                  {"relative_error", c.error},
                                  {"step", c.step},
                                  {"switched", c.switched}});
  return json;
}

class CheckGradientCommand : public Command {
 public:
  CheckGradientCommand() {
    input_.authored.edge_length = kCoarseEdge;
    scene_.step.substeps = 2;
  }
  std::string name() const override { return "check-gradient"; }
  std::string doc() const override {
    return "the derivative of a frame's cloth against differences";
  }
  void AddArguments(CLI::App* app, KeyFlags* flags) override;
  void AddOptions(OptionTable* table) override;
  ExitCode Run(const CommandContext& context) override;

 private:
  ClothState Before(const SimulationScene& scene);
  GradientCheck Check(const SimulationScene& scene,
                      const ClothState& start,
                      int* contacts);

  SimulationInput input_;
  SceneOptions scene_;
  RelaxationOptions relaxation_;
  CheckOptions check_;
  bool force_ = false;
};

void CheckGradientCommand::AddArguments(CLI::App* app, KeyFlags* flags) {
  flags->Add("--body", "input.body", "mannequin or an SMPL-layout npz");
  flags->Add("--motion", "input.motion", "embedded or an AMASS npz");
  flags->Add("--garment", "input.garment", "authored or an OBJ");
  flags->Add("--material", "scene.material", "named or an ARCSim json");
  flags->Add("--frame", "check.frame", "which to differentiate");
  flags->Add("--friction", "contact.friction", "of the cloth on the body");
  flags->Add("--substeps", "step.substeps", "steps per frame");
  app->add_flag("--force", force_, "replace an earlier report in DIR");
}

void CheckGradientCommand::AddOptions(OptionTable* table) {
  table->AddSection("input", &input_);
  Describe(table, &scene_);
  table->AddSection("relaxation", &relaxation_);
  table->AddSection("check", &check_);
}

// The cloth at the frame before the one that is checked.
ClothState CheckGradientCommand::Before(const SimulationScene& scene) {
  Simulator simulator(
      MakeSetup(scene_, scene.body, scene.garment, scene.material));
  const RelaxationResult dressed =
      Relax({scene.body, scene.garment, scene.frames, scene.motion.frame_rate},
            relaxation_,
            &simulator);
  ClothState cloth = dressed.cloth;
  RunStatus status = dressed.status;
  if (status == RunStatus::kComplete)
    status = SimulateSequence(
                 &simulator,
                 [&](int t) { return scene.body.Vertices(scene.frames[t]); },
                 check_.frame,
                 scene.motion.frame_rate,
                 &cloth)
                 .status;
  if (status == RunStatus::kFailed)
    throw InputError(input_.garment + ": cannot be simulated up to frame " +
                     std::to_string(check_.frame - 1) +
                     ": the result is not finite");
  return cloth;
}

GradientCheck CheckGradientCommand::Check(const SimulationScene& scene,
                                          const ClothState& start,
                                          int* contacts) {
  scene_.step.friction.tolerance = check_.contact_tolerance;
  Simulator simulator(
      MakeSetup(scene_, scene.body, scene.garment, scene.material));
  const BodyParameters& parameters = scene.frames[check_.frame];
  const Points previous = scene.body.Vertices(scene.frames[check_.frame - 1]);
  const double duration = 1 / scene.motion.frame_rate;
  ClothState end = start;
  StepStats stats;
  simulator.Advance(
      previous, scene.body.Vertices(parameters), duration, &end, &stats);
  *contacts = stats.most_contacts;
  return CheckFrameGradient(check_.differences,
                            scene.body,
                            previous,
                            parameters,
                            duration,
                            start,
                            &simulator);
}

ExitCode CheckGradientCommand::Run(const CommandContext& context) {
  const InterruptGuard interrupt;
  input_.motion.frames = check_.frame + 1;
  input_.motion.up_is_said = context.options->IsSet("input.motion_up");
  const SimulationScene scene = LoadSimulation(input_, scene_.material);
  if (scene.motion.num_frames() <= check_.frame)
    throw UsageError("check.frame = " + std::to_string(check_.frame) + ": " +
                     input_.motion.name + " has only frames 0 to " +
                     std::to_string(scene.motion.num_frames() - 1));
  UseMaterialFriction(*context.options, scene.material, &scene_);
  DecideSceneEffects(
      {scene.body, scene.garment, scene.frames, scene.motion.frame_rate},
      scene.material,
      relaxation_,
      &scene_);
  std::unique_ptr<RunFolder> folder;
  if (!context.out.empty())
    folder = std::make_unique<RunFolder>(context.out, force_);
  const std::string resolved = ResolvedToml(*context.options);
  const ClothState start = Before(scene);
  if (InterruptRequested()) return ExitCode::kInterrupted;
  int contacts = 0;
  const GradientCheck check = Check(scene, start, &contacts);
  if (InterruptRequested()) return ExitCode::kInterrupted;
  const std::string json = ToJson(check, contacts).dump(2) + "\n";
  if (folder) {
    folder->Write("report.json", json);
    folder->Write("config.resolved.toml", resolved);
  }
  if (context.json) {
    std::cout << json;
  } else {
    PrintTable(check, contacts);
  }
  return check.compared() > 0 && check.worst <= check_.largest_error
             ? ExitCode::kOk
             : ExitCode::kFailed;
}

}  // namespace

std::unique_ptr<Command> MakeCheckGradientCommand() {
  return std::make_unique<CheckGradientCommand>();
}

}  // namespace invsim
