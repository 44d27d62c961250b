// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_BASE_CONFIG_H_
#define INVSIM_BASE_CONFIG_H_

// What the user asked for, before anything knows what it means: dotted keys,
// their values, and where each was written. Later sources win:
//
//   Config config = Config::FromFile("scene.toml");
//   config.Merge(Config::FromFile("mine.toml"));
//   config.Assign("step.substeps=4", "--set");
//   config.Set("run.threads", "2", "--threads");
//
// An OptionTable (options.h) gives the keys their meaning.

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace invsim {

// A list of anything else, of booleans or of lists for example, each element
// as TOML. No option is set to one; a sweep tries its elements in turn.
struct ConfigList {
  std::vector<std::string> elements;
  bool operator==(const ConfigList&) const = default;
};

// A TOML scalar or a list; an empty list counts as numbers.
using ConfigValue = std::variant<bool,
                                 std::int64_t,
                                 double,
                                 std::string,
                                 std::vector<double>,
                                 std::vector<std::string>,
                                 ConfigList>;

// The value as TOML, numbers in the fewest digits that read back the same.
std::string TomlText(const ConfigValue& value);

struct ConfigEntry {
  ConfigValue value;
  // As typed on the command line, where a text needs no quotes; else empty.
  std::string text;
  // "scene.toml:3:9" (line and column) or "--set".
  std::string origin;
};

class Config {
 public:
  // Both throw UsageError naming the file, and the line and column where TOML
  // is malformed or uses what options have no use for (dates, lists of
  // tables, lists of lists of lists, control characters in keys, keys of more
  // than 16 parts, more than 32 KiB).
  static Config FromFile(const std::string& path);
  static Config FromText(std::string_view toml, const std::string& name);

  // Takes over every entry of `over`; where both have a key, `over` wins.
  void Merge(const Config& over);

  // "a.b=c"; throws UsageError if there is no key or no '='.
  void Assign(const std::string& assignment, const std::string& origin);

  // `text` is read as a TOML value if it is one, else it is a plain text.
  void Set(const std::string& key,
           const std::string& text,
           const std::string& origin);

  // In alphabetical order.
  const std::map<std::string, ConfigEntry>& entries() const { return entries_; }
  // Tables that a file opened (origin by dotted name), empty ones included.
  const std::map<std::string, std::string>& tables() const { return tables_; }

 private:
  std::map<std::string, ConfigEntry> entries_;
  std::map<std::string, std::string> tables_;
};

}  // namespace invsim

#endif  // INVSIM_BASE_CONFIG_H_
