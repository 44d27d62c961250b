// SPDX-License-Identifier: Apache-2.0

// invsim synth: writes what is embedded to files, to start from or to look at.

#include <filesystem>
#include <iostream>

#include "command.h"
#include "inputs.h"
#include "invsim/base/error.h"
#include "invsim/base/names.h"
#include "invsim/io/obj.h"

namespace invsim {
namespace {

struct SynthOptions {
  std::string body = "mannequin";
  std::string garment = "tshirt";
  AuthoredGarmentOptions authored;
  MotionInput motion;
};

void Describe(OptionTable* table, SynthOptions* o) {
  table->Add("body", &o->body, {.doc = "mannequin or an SMPL-layout npz"});
  table->Add(
      "garment",
      &o->garment,
      {.doc = "which garment to make", .choices = AuthoredGarmentNames()});
  Describe(table, &o->authored);
  Describe(table, &o->motion);
}

void WriteGarment(const std::string& path, const Garment& garment) {
  WriteObj(path,
           {garment.placed, garment.faces, garment.rest, garment.rest_faces});
}

class SynthCommand : public Command {
 public:
  std::string name() const override { return "synth"; }
  std::string doc() const override {
    return "write the embedded body, a garment made to measure, or a motion";
  }
  void AddArguments(CLI::App* app, KeyFlags* flags) override;
  void AddOptions(OptionTable* table) override {
    table->AddSection("synth", &options_);
  }
  ExitCode Run(const CommandContext& context) override;

 private:
  // The file written if --out does not say.
  std::string DefaultFile() const;
  std::string Write(const std::string& path) const;

  std::string what_;
  std::string name_;
  SynthOptions options_;
  bool force_ = false;
};

void SynthCommand::AddArguments(CLI::App* app, KeyFlags* flags) {
  app->add_option("WHAT", what_, "body, garment or motion")->required();
  app->add_option("--name", name_, "of the garment or the motion")
      ->option_text("NAME");
  flags->Add("--body", "synth.body", "round which the garment is made");
  flags->Add("--edge", "synth.edge", "edge length of the garment, m");
  flags->Add("--ease", "synth.ease", "distance from the skin, m");
  flags->Add("--frames", "synth.frames", "of the motion");
  flags->Add("--fps", "synth.frames_per_second", "of the motion");
  app->add_flag("--force", force_, "overwrite the file");
}

std::string SynthCommand::DefaultFile() const {
  if (what_ == "body") return "mannequin.npz";
  if (what_ == "garment") return options_.garment + ".obj";
  return options_.motion.name + ".npz";
}

// Returns what was written, in a few words.
std::string SynthCommand::Write(const std::string& path) const {
  const BodyModel body = LoadBody(options_.body);
  if (what_ == "body") {
    WriteBodyModel(path, body);
    return std::to_string(body.num_vertices()) + " vertices";
  }
  if (what_ == "garment") {
    const Garment garment =
        LoadGarment(options_.garment, body, options_.authored);
    WriteGarment(path, garment);
    return std::to_string(garment.num_vertices()) + " vertices, " +
           std::to_string(garment.num_faces()) + " faces";
  }
  const Motion motion = LoadMotion(options_.motion, body);
  WriteMotion(path, motion);
  return std::to_string(motion.num_frames()) + " frames";
}

ExitCode SynthCommand::Run(const CommandContext& context) {
  const std::vector<std::string> kinds = {"body", "garment", "motion"};
  if (std::find(kinds.begin(), kinds.end(), what_) == kinds.end())
    throw UsageError(UnknownName("kind", what_, kinds));
  if (!name_.empty() && what_ == "garment") options_.garment = name_;
  if (!name_.empty() && what_ == "motion") options_.motion.name = name_;
  const std::string path = context.out.empty() ? DefaultFile() : context.out;
  if (std::filesystem::exists(path) && !force_)
    throw UsageError(path + ": exists; choose another --out, or --force");
  const std::string done = Write(path);
  std::cout << path << ": " << done << "\n";
  return ExitCode::kOk;
}

}  // namespace

std::unique_ptr<Command> MakeSynthCommand() {
  return std::make_unique<SynthCommand>();
}

}  // namespace invsim
