// SPDX-License-Identifier: Apache-2.0
#include "fuzz_target.h"
#include "invsim/base/config.h"
#include "invsim/base/options.h"

namespace invsim {
namespace {

enum class Choice { kOne, kOther };

// One option of each type.
struct Options {
  bool flag = false;
  int count = 1;
  std::int64_t seed = 1;
  double size = 1;
  std::string text = "a";
  Choice choice = Choice::kOne;
  Vector3d vector = Vector3d::Zero();
  std::vector<int> counts = {1};
  std::vector<double> sizes = {1};
  std::vector<std::string> texts = {"a"};
};

void Describe(OptionTable* table, Options* o) {
  table->Add("flag", &o->flag, {.doc = ""});
  table->Add("count", &o->count, {.at_least = 0, .at_most = 1000});
  table->Add("seed", &o->seed, {.doc = ""});
  table->Add("size", &o->size, {.above = 0});
  table->Add("text", &o->text, {.doc = ""});
  table->Add("choice",
             &o->choice,
             {{"one", Choice::kOne}, {"other", Choice::kOther}},
             {.doc = ""});
  table->Add("vector", &o->vector, {.doc = ""});
  table->Add("counts", &o->counts, {.doc = ""});
  table->Add("sizes", &o->sizes, {.below = 10});
  table->Add("texts", &o->texts, {.choices = {"a", "b"}});
}

// Keys may hold dots and quotes: as quoted keys they are read back whole.
std::string Text(const Config& config) {
  std::string text;
  for (const auto& [key, entry] : config.entries()) {
    text += TomlText(ConfigValue(key)) + " = " + TomlText(entry.value) + "\n";
  }
  return text;
}

// NaN differs from itself, its text does not.
void Read(std::string_view bytes) {
  const auto config = ReadOrRefuse(
      [&] { return Config::FromText(bytes, kFuzzName); }, ErrorKind::kUsage);
  if (!config) return;
  const std::string text = Text(*config);
  Config again;
  try {
    again = Config::FromText(text, kFuzzName);
  } catch (const Error&) {
    Require(false, "a configuration written is read again");
  }
  Require(Text(again) == text, "and is the same");
  Options options;
  OptionTable table;
  table.AddSection("s", &options);
  const bool good = ReadOrRefuse(
                        [&] {
                          table.Read(*config);
                          return true;
                        },
                        ErrorKind::kUsage)
                        .has_value();
  if (!good) return;
  const Config resolved = Config::FromText(ResolvedToml(table), kFuzzName);
  Options same;
  OptionTable same_table;
  same_table.AddSection("s", &same);
  same_table.Read(resolved);
  for (std::size_t i = 0; i < table.options().size(); ++i) {
    Require(same_table.options()[i].get() == table.options()[i].get(),
            "options written down read back to the same");
  }
}

}  // namespace

const FuzzTarget kFuzzTarget = {Read};

}  // namespace invsim
