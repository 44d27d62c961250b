// SPDX-License-Identifier: Apache-2.0

// invsim inspect FILE: what it is, how large, in which unit, and whether it can
// be used.

#include <iostream>

#include "command.h"
#include "inspection.h"
#include "invsim/base/error.h"
#include "invsim/io/text_format.h"

namespace invsim {
namespace {

std::string Text(const nlohmann::ordered_json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) {
    std::string text;
    AppendNumber(' ', value.get<double>(), &text);
    return text.substr(1);
  }
  if (!value.is_array()) return value.dump();
  std::string text;
  for (const auto& item : value) {
    text += (text.empty() ? "" : " ") + Text(item);
  }
  return text;
}

void PrintText(const std::string& path, const Inspection& inspection) {
  std::cout << path << ": " << inspection.kind << "\n";
  for (const auto& [name, value] : inspection.facts.items()) {
    std::cout << "  " << name << ": " << Text(value) << "\n";
  }
  for (const std::string& warning : inspection.warnings) {
    std::cout << "  warning: " << warning << "\n";
  }
  std::cout << "  usable: " << (inspection.problem.empty() ? "yes" : "no")
            << "\n";
}

void PrintJson(const std::string& path, const Inspection& inspection) {
  nlohmann::ordered_json json;
  json["path"] = path;
  json["kind"] = inspection.kind;
  json["facts"] = inspection.facts;
  json["usable"] = inspection.problem.empty();
  json["problem"] = inspection.problem;
  json["warnings"] = inspection.warnings;
  // A path may hold any bytes, JSON only UTF-8.
  std::cout << json.dump(2,
                         ' ',
                         false,
                         nlohmann::ordered_json::error_handler_t::replace)
            << "\n";
}

class InspectCommand : public Command {
 public:
  std::string name() const override { return "inspect"; }
  std::string doc() const override {
    return "what a file is, its size and unit, and whether it can be used";
  }
  void AddArguments(CLI::App* app, KeyFlags*) override {
    app->add_option("PATH",
                    path_,
                    "body or motion (npz), garment (obj), point cloud, "
                    "directory of them, material (json), run folder")
        ->required();
  }
  void AddOptions(OptionTable*) override {}

  ExitCode Run(const CommandContext& context) override {
    const Inspection inspection = Inspect(path_);
    if (context.json) {
      PrintJson(path_, inspection);
    } else {
      PrintText(path_, inspection);
    }
    if (!inspection.problem.empty()) throw InputError(inspection.problem);
    return ExitCode::kOk;
  }

 private:
  std::string path_;
};

}  // namespace

std::unique_ptr<Command> MakeInspectCommand() {
  return std::make_unique<InspectCommand>();
}

}  // namespace invsim
