// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/sweep.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <map>
#include <set>

#include "invsim/base/error.h"

namespace invsim {
namespace {

constexpr char kReference[] = "reference";
constexpr char kPreset[] = "fit.preset";

std::string LastPart(const std::string& key) {
  return key.substr(key.rfind('.') + 1);
}

// The values of a list, each as TOML.
std::vector<std::string> Elements(const std::string& key,
                                  const ConfigEntry& entry) {
  std::vector<std::string> texts;
  if (const auto* numbers = std::get_if<std::vector<double>>(&entry.value)) {
    for (const double v : *numbers) {
      const bool whole = v == std::floor(v) && std::abs(v) < 1e15;
      texts.push_back(whole ? TomlText(static_cast<std::int64_t>(v))
                            : TomlText(v));
    }
  } else if (const auto* words =
                 std::get_if<std::vector<std::string>>(&entry.value)) {
    for (const std::string& w : *words) texts.push_back(TomlText(w));
  } else if (const auto* any = std::get_if<ConfigList>(&entry.value)) {
    texts = any->elements;
  }
  if (texts.empty())
    throw UsageError(entry.origin + ": grid." + key +
                     ": expected a list of values, such as [1, 2, 4]");
  return texts;
}

// Every combination of the old settings with the values of one more key.
std::vector<SweepSetting> Times(const std::vector<SweepSetting>& old,
                                const std::string& key,
                                const std::string& called,
                                const std::vector<std::string>& values) {
  std::vector<SweepSetting> all;
  for (const SweepSetting& s : old) {
    for (const std::string& value : values) {
      SweepSetting next = s;
      if (!next.name.empty()) next.name += ",";
      next.name += called + "=" + NameOfValue(value);
      next.options.emplace_back(key, value);
      all.push_back(std::move(next));
    }
  }
  return all;
}

// "a.b.c" -> ("a", "b.c").
std::pair<std::string, std::string> Split(const std::string& key) {
  const size_t dot = key.find('.');
  if (dot == std::string::npos) return {key, ""};
  return {key.substr(0, dot), key.substr(dot + 1)};
}

// Where the option of a setting was written.
std::string OriginOf(const SweepPlan& plan,
                     const SweepSetting& setting,
                     const std::string& key) {
  for (const std::string& full : {"list." + setting.name + "." + key,
                                  setting.name + "." + key,
                                  "grid." + key}) {
    const auto found = plan.origins.find(full);
    if (found != plan.origins.end()) return found->second;
  }
  return setting.name;
}

void CheckNames(const SweepPlan& plan) {
  std::set<std::string> names = {kReference};
  for (const SweepSetting& s : plan.settings)
    if (!names.insert(s.name).second)
      throw UsageError("sweep: two settings are called '" + s.name +
                       "'; expected different names");
  if (plan.settings.empty())
    throw UsageError(
        "sweep: nothing to try; expected a [grid] of lists or a [list.NAME]");
}

std::string Number(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g", value);
  return text;
}

}  // namespace

void Describe(OptionTable* table, SweepOptions* o) {
  table->Add("command",
             &o->command,
             {.doc = "what is run", .choices = {"simulate", "fit"}});
  table->Add(
      "repeats",
      &o->repeats,
      {.doc = "of every setting, interleaved", .at_least = 1, .at_most = 100});
  table->Add("truth",
             &o->truth,
             {.doc = "a sequence with known truth that runs are held against; "
                     "\"\": the reference run"});
  table->Add(
      "body", &o->body, {.doc = "of the truth, if there is none beside it"});
  table->Add("error",
             &o->error,
             {.doc = "key of the results that counts as error; \"\": "
                     "cloth_rms_mm, or cloth_surface_mm where meshes "
                     "differ; with a truth body_v2v_mean_mm"});
  table->Add("cost",
             &o->cost,
             {.doc = "key of the results that counts as cost; \"\": "
                     "cpu_per_simulated_second, of a fit wall_seconds"});
  table->Add("report",
             &o->report,
             {.doc = "numbers of report.json to keep as results"});
  table->Add("tolerance",
             &o->tolerance,
             {.doc = "share of the best error within which a setting counts "
                     "as good as the best",
              .at_least = 0});
}

std::string NameOfValue(const std::string& toml) {
  const bool list = toml.starts_with('[');
  std::string name;
  for (const char c : toml) {
    const bool good = std::isalnum(static_cast<unsigned char>(c)) || c == '=' ||
                      c == '.' || c == '-' || c == '_';
    const bool dropped = c == '"' || (list && std::strchr("[] ", c));
    if (good)
      name += c;
    else if (!dropped)
      name += list && c == ',' ? '+' : '_';
  }
  return name;
}

SweepPlan TakeSweepPlan(Config* config) {
  SweepPlan plan;
  std::vector<SweepSetting> grid = {{}};
  std::map<std::string, SweepSetting> list;
  bool has_grid = false;
  Config rest;
  // Options of the grid that end alike are called by their whole names.
  std::map<std::string, int> alike;
  for (const auto& [key, entry] : config->entries())
    if (Split(key).first == "grid") ++alike[LastPart(key)];
  for (const auto& [key, entry] : config->entries()) {
    const auto [part, option] = Split(key);
    const bool ours = part == "base" || part == kReference || part == "grid";
    if (ours && option.empty())
      throw UsageError(entry.origin + ": " + key + " is a section; expected " +
                       key + ".OPTION");
    if (part == "base") {
      plan.base.emplace_back(option, TomlText(entry.value));
    } else if (part == kReference) {
      plan.has_reference = true;
      plan.reference.name = kReference;
      plan.reference.options.emplace_back(option, TomlText(entry.value));
    } else if (part == "grid") {
      has_grid = true;
      const std::string last = LastPart(option);
      grid = Times(grid,
                   option,
                   alike[last] > 1 ? option : last,
                   Elements(option, entry));
    } else if (part == "list") {
      const auto [name, key_of_run] = Split(option);
      if (key_of_run.empty())
        throw UsageError(entry.origin + ": " + key +
                         ": expected list.NAME.OPTION");
      list[name].name = name;
      list[name].options.emplace_back(key_of_run, TomlText(entry.value));
    } else {
      rest.Set(key, TomlText(entry.value), entry.origin);
      continue;
    }
    plan.origins[key] = entry.origin;
  }
  if (has_grid) plan.settings = std::move(grid);
  for (auto& [name, setting] : list) plan.settings.push_back(setting);
  CheckNames(plan);
  *config = std::move(rest);
  return plan;
}

Config ConfigOf(const SweepPlan& plan, const SweepSetting& setting) {
  Config config;
  for (const auto& [key, value] : plan.base)
    config.Set(key, value, plan.origins.at("base." + key));
  for (const auto& [key, value] : setting.options)
    config.Set(key, value, OriginOf(plan, setting, key));
  return config;
}

SweepSpread SpreadOf(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const size_t n = values.size();
  return {0.5 * (values[(n - 1) / 2] + values[n / 2]),
          values.front(),
          values.back()};
}

void SweepResult::Add(const std::string& key,
                      const std::vector<double>& repeats) {
  if (repeats.empty()) return;
  const SweepSpread spread = SpreadOf(repeats);
  values.emplace_back(key, spread.median);
  if (spread.least == spread.largest) return;
  values.emplace_back(key + "_least", spread.least);
  values.emplace_back(key + "_largest", spread.largest);
}

void MarkPareto(std::vector<SweepResult>* results) {
  for (SweepResult& r : *results) {
    r.pareto = r.usable;
    for (const SweepResult& other : *results) {
      if (!other.usable) continue;
      const bool as_good =
          other.error <= r.error && other.cost.median <= r.cost.median;
      const bool better =
          other.error < r.error || other.cost.median < r.cost.median;
      if (as_good && better) r.pareto = false;
    }
  }
}

std::string SettingInWords(const SweepSetting& setting) {
  if (setting.options.size() != 1 || setting.options[0].first != kPreset)
    return setting.name;
  std::string preset = setting.options[0].second;
  preset.erase(std::remove(preset.begin(), preset.end(), '"'), preset.end());
  return "--preset " + preset;
}

std::string SweepVerdict(const std::vector<SweepResult>& results,
                         double tolerance,
                         const std::string& cost) {
  const SweepResult* best = nullptr;
  for (const SweepResult& r : results)
    if (r.usable &&
        (!best || r.error < best->error ||
         (r.error == best->error && r.cost.median < best->cost.median)))
      best = &r;
  if (!best) return "no setting succeeded";
  const SweepResult* chosen = best;
  for (const SweepResult& r : results)
    if (r.usable && r.error <= (1 + tolerance) * best->error &&
        r.cost.largest < best->cost.least &&
        r.cost.median < chosen->cost.median)
      chosen = &r;
  const std::string error = Number(best->error);
  const std::string name = SettingInWords(best->setting);
  if (chosen == best)
    return "best error " + error + ": " + name +
           "; nothing surely cheaper comes within " + Number(100 * tolerance) +
           " %";
  const double ratio = best->cost.median / chosen->cost.median;
  return "within " + Number(100 * tolerance) + " % of the best error (" +
         error + ", " + name + ") at 1/" + Number(ratio) + " of the " + cost +
         ": " + SettingInWords(chosen->setting);
}

}  // namespace invsim
