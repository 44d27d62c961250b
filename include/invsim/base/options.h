// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_BASE_OPTIONS_H_
#define INVSIM_BASE_OPTIONS_H_

// Options are plain structs with their defaults on the members. Beside each
// stands one function that tells, as data, what its members are called, what
// they mean, their unit and their range:
//
//   struct StepOptions {
//     int substeps = 3;
//     double tolerance = 1e-8;
//   };
//
//   void Describe(OptionTable* table, StepOptions* o) {
//     table->Add("substeps", &o->substeps,
//                {.doc = "linearly implicit steps per frame", .at_least = 1});
//     table->Add("tolerance", &o->tolerance,
//                {.doc = "contact residual at which a step is done",
//                 .unit = "vertex weights", .above = 0});
//   }
//
// Everything else follows from the table: reading a configuration, checking
// it, listing the options, and writing down what a run used.
//
//   StepOptions step;
//   OptionTable table;
//   table.AddSection("step", &step);   // keys step.substeps, step.tolerance
//   table.Read(config);                // throws UsageError

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "invsim/base/config.h"
#include "invsim/base/names.h"
#include "invsim/base/types.h"

namespace invsim {

// What a member means and which values it may have. The bounds hold for a
// number and for every number of a list. Infinity and NaN are never accepted.
struct OptionInfo {
  std::string doc = "";
  std::string unit = "";  // "" has none; SI otherwise
  double at_least = -std::numeric_limits<double>::infinity();
  double at_most = std::numeric_limits<double>::infinity();
  double above = -std::numeric_limits<double>::infinity();
  double below = std::numeric_limits<double>::infinity();
  // What a text, or each text of a list, may be; empty: anything.
  std::vector<std::string> choices = {};
};

class OptionTable {
 public:
  // One registered member, as data.
  struct Option {
    std::string key;  // "step.substeps"
    OptionInfo info;
    // "an integer >= 1", "one of lm, dogleg", "a number > 0 [m]".
    std::string expected;
    ConfigValue default_value;  // the member's value when it was added
    std::string origin;         // where the value was set; "" if nowhere
    std::function<ConfigValue()> get;
    // False if the value has another type or breaks a bound; the member then
    // keeps its value.
    std::function<bool(const ConfigValue&)> set;
  };

  OptionTable() = default;
  // The table points into the option structs and is of no use as a copy.
  OptionTable(const OptionTable&) = delete;
  OptionTable& operator=(const OptionTable&) = delete;

  // Registers a member: bool, int, std::int64_t, double, std::string,
  // Vector3d, or a std::vector of int, double or std::string (of which one may
  // be given without brackets). It must outlive the table. A key registered
  // twice is a programming error (throws std::logic_error), and so is a default
  // that its own bounds refuse.
  template <typename T>
  requires(!std::is_enum_v<T>) void Add(const std::string& key,
                                        T* member,
                                        OptionInfo info);

  // An enumeration, written by the names given for its values.
  template <typename E>
  requires(std::is_enum_v<E>) void Add(
      const std::string& key,
      E* member,
      const std::vector<std::pair<std::string, E>>& names,
      OptionInfo info);

  // Describes `options`, with its keys under "name.". Sections nest.
  template <typename Options>
  void AddSection(const std::string& name, Options* options) {
    const std::string outer = prefix_;
    prefix_ += name + ".";
    Describe(this, options);  // found beside the struct
    prefix_ = outer;
  }

  // Sets the members the configuration names. Throws UsageError, in one line,
  // for an unknown key (origin, nearest known name) or a bad value (origin,
  // key, value, what was expected).
  void Read(const Config& config);

  // In the order of registration.
  const std::vector<Option>& options() const { return options_; }
  std::vector<std::string> keys() const;
  // Whether a configuration gave this key a value.
  bool IsSet(const std::string& key) const;

 private:
  void AddOption(Option option);
  Option& Find(const std::string& key, const std::string& origin);

  std::string prefix_;
  std::vector<Option> options_;
};

// Options of something that has none.
struct NoOptions {};
inline void Describe(OptionTable*, NoOptions*) {}

// The whole table as TOML that reads back to the same options; each line ends
// with the unit and where the value came from.
std::string ResolvedToml(const OptionTable& table);

// For people: per option its key, default, what is expected, and what it does.
std::string OptionsText(const OptionTable& table);

// ---------------------------------------------------------------------------

template <typename E>
requires(std::is_enum_v<E>) void OptionTable::Add(
    const std::string& key,
    E* member,
    const std::vector<std::pair<std::string, E>>& names,
    OptionInfo info) {
  info.choices.clear();
  for (const auto& [name, value] : names) info.choices.push_back(name);
  Option option;
  option.key = key;
  option.info = std::move(info);
  option.get = [member, names]() -> ConfigValue {
    for (const auto& [name, value] : names)
      if (value == *member) return name;
    return std::string();
  };
  option.set = [member, names](const ConfigValue& text) {
    for (const auto& [name, value] : names) {
      if (text != ConfigValue(name)) continue;
      *member = value;
      return true;
    }
    return false;
  };
  option.expected = "one of " + Join(option.info.choices);
  AddOption(std::move(option));
}

}  // namespace invsim

#endif  // INVSIM_BASE_OPTIONS_H_
