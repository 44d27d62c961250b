// SPDX-License-Identifier: Apache-2.0
#include "invsim/base/options.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "invsim/base/error.h"

namespace invsim {
namespace {

// --- Between a member's type and a ConfigValue. ---

template <typename T>
struct Convert;

template <>
struct Convert<bool> {
  static constexpr char kNoun[] = "true or false";
  static ConfigValue ToValue(bool x) { return x; }
  static std::optional<bool> FromValue(const ConfigValue& value) {
    const bool* x = std::get_if<bool>(&value);
    return x ? std::optional(*x) : std::nullopt;
  }
};

template <>
struct Convert<std::int64_t> {
  static constexpr char kNoun[] = "an integer";
  static ConfigValue ToValue(std::int64_t x) { return x; }
  static std::optional<std::int64_t> FromValue(const ConfigValue& value) {
    const std::int64_t* x = std::get_if<std::int64_t>(&value);
    return x ? std::optional(*x) : std::nullopt;
  }
};

template <>
struct Convert<int> {
  static constexpr char kNoun[] = "an integer";
  static ConfigValue ToValue(int x) { return std::int64_t{x}; }
  static std::optional<int> FromValue(const ConfigValue& value) {
    const auto x = Convert<std::int64_t>::FromValue(value);
    if (!x || *x != static_cast<int>(*x)) return std::nullopt;
    return static_cast<int>(*x);
  }
};

template <>
struct Convert<double> {
  static constexpr char kNoun[] = "a number";
  static ConfigValue ToValue(double x) { return x; }
  static std::optional<double> FromValue(const ConfigValue& value) {
    if (const auto* x = std::get_if<std::int64_t>(&value))
      return static_cast<double>(*x);
    const double* x = std::get_if<double>(&value);
    return x && std::isfinite(*x) ? std::optional(*x) : std::nullopt;
  }
};

template <>
struct Convert<std::string> {
  static constexpr char kNoun[] = "a text";
  static ConfigValue ToValue(const std::string& x) { return x; }
  static std::optional<std::string> FromValue(const ConfigValue& value) {
    const std::string* x = std::get_if<std::string>(&value);
    return x ? std::optional(*x) : std::nullopt;
  }
};

template <>
struct Convert<std::vector<double>> {
  static constexpr char kNoun[] = "a list of numbers";
  static ConfigValue ToValue(const std::vector<double>& x) { return x; }
  static std::optional<std::vector<double>> FromValue(
      const ConfigValue& value) {
    const auto* list = std::get_if<std::vector<double>>(&value);
    if (!list) return std::nullopt;
    for (const double x : *list)
      if (!std::isfinite(x)) return std::nullopt;
    return *list;
  }
};

template <>
struct Convert<std::vector<int>> {
  static constexpr char kNoun[] = "a list of integers";
  static ConfigValue ToValue(const std::vector<int>& x) {
    return std::vector<double>(x.begin(), x.end());
  }
  static std::optional<std::vector<int>> FromValue(const ConfigValue& value) {
    const auto list = Convert<std::vector<double>>::FromValue(value);
    if (!list) return std::nullopt;
    std::vector<int> integers;
    for (const double x : *list) {
      if (std::abs(x) > std::numeric_limits<int>::max() || x != std::floor(x))
        return std::nullopt;
      integers.push_back(static_cast<int>(x));
    }
    return integers;
  }
};

template <>
struct Convert<std::vector<std::string>> {
  static constexpr char kNoun[] = "a list of texts";
  static ConfigValue ToValue(const std::vector<std::string>& x) { return x; }
  static std::optional<std::vector<std::string>> FromValue(
      const ConfigValue& value) {
    const auto* numbers = std::get_if<std::vector<double>>(&value);
    if (numbers && numbers->empty()) return std::vector<std::string>();
    if (const auto* one = std::get_if<std::string>(&value))
      return std::vector<std::string>{*one};
    const auto* list = std::get_if<std::vector<std::string>>(&value);
    return list ? std::optional(*list) : std::nullopt;
  }
};

template <>
struct Convert<Vector3d> {
  static constexpr char kNoun[] = "a list of three numbers";
  static ConfigValue ToValue(const Vector3d& x) {
    return std::vector<double>(x.data(), x.data() + 3);
  }
  static std::optional<Vector3d> FromValue(const ConfigValue& value) {
    const auto list = Convert<std::vector<double>>::FromValue(value);
    if (!list || list->size() != 3) return std::nullopt;
    return Vector3d((*list)[0], (*list)[1], (*list)[2]);
  }
};

// --- Bounds. ---

bool Allowed(const OptionInfo& info, double x) {
  return x >= info.at_least && x <= info.at_most &&
         (std::isinf(info.above) || x > info.above) &&
         (std::isinf(info.below) || x < info.below);
}

bool Allowed(const OptionInfo& info, const std::string& text) {
  return info.choices.empty() ||
         std::find(info.choices.begin(), info.choices.end(), text) !=
             info.choices.end();
}

bool Allowed(const OptionInfo&, bool) { return true; }

// What no option takes.
bool Allowed(const OptionInfo&, const ConfigList&) { return false; }

template <typename T>
bool Allowed(const OptionInfo& info, const std::vector<T>& list) {
  return std::all_of(
      list.begin(), list.end(), [&](const T& x) { return Allowed(info, x); });
}

bool AllowedValue(const OptionInfo& info, const ConfigValue& value) {
  return std::visit(
      [&](const auto& x) {
        if constexpr (std::is_same_v<std::decay_t<decltype(x)>, std::int64_t>)
          return Allowed(info, static_cast<double>(x));
        else
          return Allowed(info, x);
      },
      value);
}

// A bound as people write it: 1, 0.5, 1e-08.
std::string BoundText(double x) {
  std::string text = TomlText(x);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text;
}

std::string ExpectedText(const std::string& noun, const OptionInfo& info) {
  std::string text = noun;
  if (!info.choices.empty())
    text = (noun == Convert<std::string>::kNoun ? "one of "
                                                : noun + ", each one of ") +
           Join(info.choices);
  const char* join = " ";
  const auto bound = [&](const char* sign, double x) {
    if (std::isinf(x)) return;
    text += join + (sign + (" " + BoundText(x)));
    join = " and ";
  };
  bound(">=", info.at_least);
  bound(">", info.above);
  bound("<=", info.at_most);
  bound("<", info.below);
  return info.unit.empty() ? text : text + " [" + info.unit + "]";
}

// --- Messages. ---

[[noreturn]] void ThrowBadValue(const OptionTable::Option& option,
                                const ConfigEntry& entry) {
  std::string text = entry.origin + ": " + option.key + " = " +
                     TomlText(entry.value) + ": expected " + option.expected;
  const auto* name = std::get_if<std::string>(&entry.value);
  if (name && name->find(',') == std::string::npos) {
    const std::string nearest = NearestName(*name, option.info.choices);
    if (!nearest.empty()) text += "; did you mean '" + nearest + "'?";
  }
  throw UsageError(text);
}

bool IsSection(const std::vector<std::string>& keys, const std::string& name) {
  return std::any_of(keys.begin(), keys.end(), [&](const std::string& key) {
    return key.starts_with(name + ".");
  });
}

std::vector<std::string> SectionNames(const std::vector<std::string>& keys) {
  std::vector<std::string> names;
  for (const std::string& key : keys) {
    for (size_t dot = key.find('.'); dot != std::string::npos;
         dot = key.find('.', dot + 1)) {
      const std::string name = key.substr(0, dot);
      if (std::find(names.begin(), names.end(), name) == names.end())
        names.push_back(name);
    }
  }
  return names;
}

[[noreturn]] void ThrowUnknownKey(const std::vector<std::string>& keys,
                                  const std::string& key,
                                  const std::string& origin) {
  if (IsSection(keys, key))
    throw UsageError(origin + ": '" + key +
                     "' is a section, not an option; expected " + key +
                     ".<option>");
  std::string text = origin + ": unknown option '" + key + "'";
  const std::string nearest = NearestName(key, keys);
  if (!nearest.empty())
    text += "; did you mean '" + nearest + "'?";
  else
    text += "; `invsim list options` names them all";
  throw UsageError(text);
}

}  // namespace

// On the command line a list of names may be written a,b,c.
template <typename T>
ConfigValue Unfolded(const OptionInfo& info, const ConfigValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  if constexpr (std::is_same_v<T, std::vector<std::string>>)
    if (text && !text->empty() && !info.choices.empty()) {
      std::vector<std::string> names;
      std::istringstream parts(*text);
      for (std::string name; std::getline(parts >> std::ws, name, ',');)
        names.push_back(name);
      return names;
    }
  return value;
}

template <typename T>
requires(!std::is_enum_v<T>) void OptionTable::Add(const std::string& key,
                                                   T* member,
                                                   OptionInfo info) {
  Option option;
  option.key = key;
  option.expected = ExpectedText(Convert<T>::kNoun, info);
  option.info = info;
  option.get = [member] { return Convert<T>::ToValue(*member); };
  option.set = [member, info](const ConfigValue& given) {
    const ConfigValue value = Unfolded<T>(info, given);
    const std::optional<T> x = Convert<T>::FromValue(value);
    if (!x || !AllowedValue(info, value)) return false;
    *member = *x;
    return true;
  };
  AddOption(std::move(option));
}

template void OptionTable::Add(const std::string&, bool*, OptionInfo);
template void OptionTable::Add(const std::string&, int*, OptionInfo);
template void OptionTable::Add(const std::string&, std::int64_t*, OptionInfo);
template void OptionTable::Add(const std::string&, double*, OptionInfo);
template void OptionTable::Add(const std::string&, std::string*, OptionInfo);
template void OptionTable::Add(const std::string&, Vector3d*, OptionInfo);
template void OptionTable::Add(const std::string&,
                               std::vector<int>*,
                               OptionInfo);
template void OptionTable::Add(const std::string&,
                               std::vector<double>*,
                               OptionInfo);
template void OptionTable::Add(const std::string&,
                               std::vector<std::string>*,
                               OptionInfo);

void OptionTable::AddOption(Option option) {
  option.key = prefix_ + option.key;
  for (const Option& other : options_)
    if (other.key == option.key)
      throw std::logic_error("option '" + option.key + "' registered twice");
  option.default_value = option.get();
  if (!option.set(option.default_value))
    throw std::logic_error("option '" + option.key + "' has the default " +
                           TomlText(option.default_value) + ", expected " +
                           option.expected);
  options_.push_back(std::move(option));
}

bool OptionTable::IsSet(const std::string& key) const {
  for (const Option& option : options_)
    if (option.key == key) return !option.origin.empty();
  return false;
}

std::vector<std::string> OptionTable::keys() const {
  std::vector<std::string> keys;
  for (const Option& option : options_) keys.push_back(option.key);
  return keys;
}

OptionTable::Option& OptionTable::Find(const std::string& key,
                                       const std::string& origin) {
  for (Option& option : options_)
    if (option.key == key) return option;
  ThrowUnknownKey(keys(), key, origin);
}

void OptionTable::Read(const Config& config) {
  // An empty or misspelt table has no entry that would give it away.
  const std::vector<std::string> sections = SectionNames(keys());
  for (const auto& [name, origin] : config.tables())
    if (!IsSection(keys(), name))
      throw UsageError(origin + ": " + UnknownName("section", name, sections));
  for (const auto& [key, entry] : config.entries()) {
    Option& option = Find(key, entry.origin);
    // On the command line a text that looks like a number is still a text.
    const bool set = option.set(entry.value) ||
                     (!entry.text.empty() && option.set(entry.text));
    if (!set) ThrowBadValue(option, entry);
    option.origin = entry.origin;
  }
}

std::string ResolvedToml(const OptionTable& table) {
  // TOML wants the keys without a section first; then one table a section.
  std::vector<std::string> sections = {""};
  const auto section = [](const OptionTable::Option& option) {
    const size_t dot = option.key.rfind('.');
    return dot == std::string::npos ? "" : option.key.substr(0, dot);
  };
  for (const auto& option : table.options())
    if (std::find(sections.begin(), sections.end(), section(option)) ==
        sections.end())
      sections.push_back(section(option));

  std::string text;
  for (const std::string& name : sections) {
    if (!name.empty()) text += (text.empty() ? "[" : "\n[") + name + "]\n";
    for (const auto& option : table.options()) {
      if (section(option) != name) continue;
      const size_t skip = name.empty() ? 0 : name.size() + 1;
      text += option.key.substr(skip) + " = " + TomlText(option.get()) + "  #";
      if (!option.info.unit.empty()) text += " " + option.info.unit + ",";
      text += " " + (option.origin.empty() ? "default" : option.origin) + "\n";
    }
  }
  return text;
}

std::string OptionsText(const OptionTable& table) {
  std::string text;
  for (const auto& option : table.options()) {
    text += option.key + " = " + TomlText(option.default_value) + "  (" +
            option.expected + ")\n";
    if (!option.info.doc.empty()) text += "    " + option.info.doc + "\n";
  }
  return text;
}

}  // namespace invsim
