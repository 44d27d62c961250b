// SPDX-License-Identifier: Apache-2.0

// invsim list: what there is to choose from.

#include <iostream>
#include <nlohmann/json.hpp>

#include "command.h"
#include "invsim/base/error.h"
#include "invsim/base/names.h"
#include "invsim/body/motion_library.h"
#include "invsim/cloth/authored_garment.h"
#include "invsim/cloth/effect_registry.h"
#include "invsim/cloth/named_materials.h"
#include "invsim/fit/loss.h"
#include "invsim/fit/optimizer.h"
#include "presets.h"

namespace invsim {
namespace {

using Json = nlohmann::ordered_json;

struct Item {
  std::string name;
  std::string doc;
  std::string options;  // OptionsText, "" if there are none
};

std::vector<Item> EffectItems() {
  std::vector<Item> items;
  for (const auto& entry : Effects().entries()) {
    OptionTable table;
    const auto choice = entry.choose();
    table.AddSection("effects." + entry.name, choice.get());
    items.push_back({entry.name, entry.doc, OptionsText(table)});
  }
  return items;
}

std::vector<Item> MaterialItems() {
  std::vector<Item> items;
  for (const Material& material : NamedMaterials()) {
    char figures[64];
    std::snprintf(figures,
                  sizeof(figures),
                  ": %.3f kg/m^2, friction on skin %.2g",
                  material.density,
                  material.friction);
    items.push_back({material.name, material.doc + figures, ""});
  }
  return items;
}

std::vector<Item> LossItems() {
  std::vector<Item> items;
  for (const auto& entry : Losses().entries())
    items.push_back({entry.name, entry.doc, ""});
  return items;
}

std::vector<Item> OptimizerItems() {
  std::vector<Item> items;
  for (const auto& entry : Optimizers().entries()) {
    OptionTable table;
    const auto choice = entry.choose();
    table.AddSection(entry.name, choice.get());
    items.push_back({entry.name, entry.doc, OptionsText(table)});
  }
  return items;
}

std::vector<Item> GarmentItems() {
  std::vector<Item> items;
  for (const std::string& name : AuthoredGarmentNames())
    items.push_back({name, "made round any body; see invsim synth", ""});
  return items;
}

std::vector<Item> MotionItems() {
  std::vector<Item> items;
  for (const std::string& name : MotionNames())
    items.push_back({name, MotionDescription(name), ""});
  return items;
}

std::vector<Item> PresetItems() {
  std::vector<Item> items;
  for (const Preset& preset : Presets())
    items.push_back({preset.name, preset.doc, preset.settings});
  return items;
}

// Every option of every command that has any but those that all have.
std::vector<Item> OptionItems() {
  std::vector<Item> items;
  for (const std::unique_ptr<Command>& command : AllCommands()) {
    OptionTable table;
    command->AddOptions(&table);
    if (!table.options().empty())
      items.push_back({command->name(), command->doc(), OptionsText(table)});
  }
  return items;
}

struct Kind {
  std::string name;
  std::vector<Item> (*items)();
};

const std::vector<Kind>& Kinds() {
  static const std::vector<Kind> kinds = {{"effects", EffectItems},
                                          {"materials", MaterialItems},
                                          {"garments", GarmentItems},
                                          {"motions", MotionItems},
                                          {"losses", LossItems},
                                          {"optimizers", OptimizerItems},
                                          {"presets", PresetItems},
                                          {"options", OptionItems}};
  return kinds;
}

std::vector<std::string> KindNames() {
  std::vector<std::string> names;
  for (const Kind& kind : Kinds()) names.push_back(kind.name);
  return names;
}

void Print(const Kind& kind) {
  for (const Item& item : kind.items()) {
    std::cout << item.name << "\n    " << item.doc << "\n";
    if (!item.options.empty()) std::cout << item.options;
  }
}

Json ToJson(const Kind& kind) {
  Json json = Json::array();
  for (const Item& item : kind.items())
    json.push_back({{"name", item.name}, {"doc", item.doc}});
  return json;
}

class ListCommand : public Command {
 public:
  std::string name() const override { return "list"; }
  std::string doc() const override {
    return "what there is to choose from: " + Join(KindNames());
  }
  void AddArguments(CLI::App* app, KeyFlags*) override {
    app->add_option("WHAT", what_, Join(KindNames()))->required();
  }
  void AddOptions(OptionTable*) override {}

  ExitCode Run(const CommandContext& context) override {
    for (const Kind& kind : Kinds()) {
      if (kind.name != what_) continue;
      if (context.json) {
        std::cout << ToJson(kind).dump(2) << "\n";
      } else {
        Print(kind);
      }
      return ExitCode::kOk;
    }
    throw UsageError(UnknownName("list", what_, KindNames()));
  }

 private:
  std::string what_;
};

}  // namespace

std::unique_ptr<Command> MakeListCommand() {
  return std::make_unique<ListCommand>();
}

}  // namespace invsim
