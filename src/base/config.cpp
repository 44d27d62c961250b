// SPDX-License-Identifier: Apache-2.0
#include "invsim/base/config.h"

#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "invsim/base/error.h"
#include "invsim/base/names.h"
#include "toml_letters.h"

namespace invsim {
namespace {

std::string Where(const std::string& name, const toml::source_region& source) {
  return name + ":" + std::to_string(source.begin.line) + ":" +
         std::to_string(source.begin.column);
}

bool IsControl(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
}

std::optional<ConfigValue> ScalarFromToml(const toml::node& node) {
  if (const auto* v = node.as_boolean()) return v->get();
  if (const auto* v = node.as_integer()) return v->get();
  if (const auto* v = node.as_floating_point()) return v->get();
  if (const auto* v = node.as_string()) return Decoded(v->get());
  return std::nullopt;
}

// A list of numbers or of texts.
std::optional<ConfigValue> PlainListFromToml(const toml::array& array) {
  std::vector<double> numbers;
  std::vector<std::string> texts;
  for (const toml::node& node : array) {
    if (const auto* text = node.as_string())
      texts.push_back(Decoded(text->get()));
    else if (node.is_number())
      numbers.push_back(*node.value<double>());
    else
      return std::nullopt;
  }
  if (texts.empty()) return numbers;
  if (numbers.empty()) return texts;
  return std::nullopt;
}

// A list of scalars and of such lists.
std::optional<ConfigValue> ListFromToml(const toml::array& array) {
  ConfigList list;
  for (const toml::node& node : array) {
    const auto* inner = node.as_array();
    const std::optional<ConfigValue> element =
        inner ? PlainListFromToml(*inner) : ScalarFromToml(node);
    if (!element) return std::nullopt;
    list.elements.push_back(TomlText(*element));
  }
  return list;
}

std::optional<ConfigValue> FromToml(const toml::node& node) {
  const auto* array = node.as_array();
  if (!array) return ScalarFromToml(node);
  const std::optional<ConfigValue> plain = PlainListFromToml(*array);
  return plain ? plain : ListFromToml(*array);
}

// toml++ takes keys of any number of parts apart by recursion, and ends the
// process where the stack ends (seen at 30,000 parts). Options fill a few
// kilobytes and have three parts at most.
constexpr size_t kLongestFile = 32 << 10;
constexpr int kMostParts = 16;

void CheckKey(const std::string& key, const std::string& origin) {
  if (std::any_of(key.begin(), key.end(), IsControl))
    throw UsageError(origin + ": key " + TomlText(ConfigValue(key)) +
                     ": expected no control character");
}

// What toml++ complains of; it quotes the file as it is.
std::string Complaint(const toml::parse_error& error) {
  std::string text(error.description());
  std::replace_if(text.begin(), text.end(), IsControl, '?');
  return text;
}

// Calls `entry(key, node, origin)` for every value below `table` and
// `opened(key, origin)` for every table.
template <typename Entry, typename Opened>
void Flatten(const toml::table& table,
             const std::string& prefix,
             const std::string& name,
             const Entry& entry,
             const Opened& opened,
             int parts = 1) {
  for (const auto& [key, node] : table) {
    const std::string full = prefix + Decoded(key.str());
    const std::string origin = Where(name, key.source());
    CheckKey(full, origin);
    if (parts > kMostParts)
      throw UsageError(origin + ": " + full + ": expected a key of at most " +
                       std::to_string(kMostParts) + " parts");
    if (const auto* inner = node.as_table()) {
      opened(full, origin);
      Flatten(*inner, full + ".", name, entry, opened, parts + 1);
    } else {
      entry(full, node, origin);
    }
  }
}

// A command-line text as a TOML value; nullopt if it is none. A '#' outside
// quotes would silently cut the text, a line break would add keys.
std::optional<ConfigValue> ParseValue(const std::string& text) {
  const bool quoted =
      text.starts_with('"') || text.starts_with('\'') || text.starts_with('[');
  if (text.find('\n') != std::string::npos) return std::nullopt;
  if (!quoted && text.find('#') != std::string::npos) return std::nullopt;
  if (!LetterComplaint(text).empty()) return std::nullopt;
  try {
    const toml::table table = toml::parse("value = " + Encoded(text));
    return FromToml(*table.get("value"));
  } catch (const toml::parse_error&) {
    return std::nullopt;
  }
}

std::string NumberText(double x) {
  if (std::isnan(x)) return "nan";
  if (std::isinf(x)) return x > 0 ? "inf" : "-inf";
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof(buffer), x).ptr;
  std::string text(buffer, end);
  // TOML tells floats from integers by the point or the exponent.
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string QuotedText(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      constexpr char kHex[] = "0123456789abcdef";
      quoted += "\\u00";
      quoted += kHex[(c >> 4) & 15];
      quoted += kHex[c & 15];
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

std::string ItemText(double x) { return NumberText(x); }
std::string ItemText(const std::string& x) { return QuotedText(x); }

struct TomlWriter {
  std::string operator()(bool x) const { return x ? "true" : "false"; }
  std::string operator()(std::int64_t x) const { return std::to_string(x); }
  std::string operator()(double x) const { return NumberText(x); }
  std::string operator()(const std::string& x) const { return QuotedText(x); }
  template <typename T>
  std::string operator()(const std::vector<T>& list) const {
    std::string text = "[";
    for (const T& item : list) {
      if (text.size() > 1) text += ", ";
      text += ItemText(item);
    }
    return text + "]";
  }
  std::string operator()(const ConfigList& list) const {
    return "[" + Join(list.elements) + "]";
  }
};

}  // namespace

std::string TomlText(const ConfigValue& value) {
  return std::visit(TomlWriter(), value);
}

Config Config::FromFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file) text << file.rdbuf();
  if (!file || std::filesystem::is_directory(path))
    throw UsageError(path + ": cannot be read; expected a TOML file");
  return FromText(text.str(), path);
}

Config Config::FromText(std::string_view toml, const std::string& name) {
  if (toml.size() > kLongestFile)
    throw UsageError(name + ": " + std::to_string(toml.size()) +
                     " bytes: expected a configuration of at most " +
                     std::to_string(kLongestFile));
  if (toml.starts_with("\xef\xbb\xbf")) toml.remove_prefix(3);
  if (const std::string bad = LetterComplaint(toml); !bad.empty())
    throw UsageError(name + ": " + bad);
  toml::table table;
  try {
    table = toml::parse(Encoded(toml));
  } catch (const toml::parse_error& error) {
    throw UsageError(Where(name, error.source()) + ": " + Complaint(error));
  }
  Config config;
  const auto entry = [&](const std::string& key,
                         const toml::node& node,
                         const std::string& origin) {
    const std::optional<ConfigValue> value = FromToml(node);
    if (!value)
      throw UsageError(origin + ": " + key +
                       ": expected a number, a text, true, false or a list of "
                       "these");
    config.entries_[key] = {*value, "", origin};
  };
  const auto opened = [&](const std::string& key, const std::string& origin) {
    config.tables_[key] = origin;
  };
  Flatten(table, "", name, entry, opened);
  return config;
}

void Config::Merge(const Config& over) {
  for (const auto& [key, entry] : over.entries_) entries_[key] = entry;
  for (const auto& [key, origin] : over.tables_) tables_[key] = origin;
}

void Config::Assign(const std::string& assignment, const std::string& origin) {
  const size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0)
    throw UsageError(origin + " '" + assignment + "': expected key=value");
  Set(assignment.substr(0, equals), assignment.substr(equals + 1), origin);
}

void Config::Set(const std::string& key,
                 const std::string& text,
                 const std::string& origin) {
  entries_[key] = {ParseValue(text).value_or(text), text, origin};
}

}  // namespace invsim
