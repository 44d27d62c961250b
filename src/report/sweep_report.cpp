// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/sweep_report.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "invsim/report/chart.h"
#include "sweep_report_parts.h"
#include "text_line.h"

namespace invsim {

std::vector<const SweepResult*> CheapestFirst(const SweepReport& report) {
  std::vector<const SweepResult*> sorted;
  for (const SweepResult& r : report.results) sorted.push_back(&r);
  std::stable_sort(sorted.begin(), sorted.end(), [](auto* a, auto* b) {
    if (a->usable != b->usable) return a->usable;
    return a->cost.median < b->cost.median;
  });
  return sorted;
}

std::string OptionsOf(const SweepSetting& setting, const char* separator) {
  std::string text;
  for (const auto& [key, value] : setting.options)
    text += (text.empty() ? "" : separator) + key + " = " + value;
  return text;
}

std::vector<std::string> ValueKeys(const SweepReport& report) {
  std::vector<std::string> keys;
  for (const SweepResult& r : report.results)
    for (const auto& [key, value] : r.values)
      if (std::find(keys.begin(), keys.end(), key) == keys.end())
        keys.push_back(key);
  return keys;
}

const double* Find(const SweepResult& r, const std::string& key) {
  for (const auto& [name, value] : r.values)
    if (name == key) return &value;
  return nullptr;
}

std::string VerdictOf(const SweepReport& report) {
  const bool time = report.cost_key.find("second") != std::string::npos;
  return SweepVerdict(report.results, report.tolerance, time ? "time" : "cost");
}

namespace {

using Json = nlohmann::ordered_json;

// Solver work: it carries over to other machines as seconds do not.
struct WorkColumn {
  const char* title;
  std::vector<std::string> keys;  // the first that there is
};
const std::vector<WorkColumn>& WorkColumns() {
  static const std::vector<WorkColumn> columns = {
      {"factoris.", {"sequence.factorizations", "simulation.factorizations"}},
      {"solves", {"sequence.solves", "simulation.solves"}},
      {"queries", {"sequence.contact_queries", "simulation.contact_queries"}}};
  return columns;
}

std::string WorkText(const SweepResult& r, const WorkColumn& column) {
  for (const std::string& key : column.keys)
    if (const double* value = Find(r, key)) return ShortNumber(*value);
  return "-";
}

}  // namespace

std::string SweepJson(const SweepReport& report) {
  Json json;
  json["schema"] = "invsim.sweep";
  json["schema_version"] = kSweepSchemaVersion;
  json["command"] = report.command;
  json["held_against"] = report.held_against;
  json["error"] = report.error_key;
  json["cost"] = report.cost_key;
  json["repeats"] = report.repeats;
  json["verdict"] = VerdictOf(report);
  json["results"] = Json::array();
  for (const SweepResult& r : report.results) {
    Json row;
    row["name"] = r.setting.name;
    row["options"] = Json::object();
    for (const auto& [key, value] : r.setting.options)
      row["options"][key] = value;
    row["usable"] = r.usable;
    row["exit_codes"] = r.exit_codes;
    if (!r.usable) row["failure"] = r.failure;
    row["pareto"] = r.pareto;
    row["values"] = Json::object();
    for (const auto& [key, value] : r.values) row["values"][key] = value;
    if (!r.frame_errors_mm.empty())
      row["cloth_rms_by_frame_mm"] = r.frame_errors_mm;
    json["results"].push_back(std::move(row));
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string SweepCsv(const SweepReport& report) {
  const std::vector<std::string> keys = ValueKeys(report);
  std::ostringstream out;
  out.precision(9);
  out << "name,options,usable,failure,pareto";
  for (const std::string& key : keys) out << ',' << key;
  out << '\n';
  for (const SweepResult& r : report.results) {
    out << CsvQuoted(r.setting.name) << ','
        << CsvQuoted(OptionsOf(r.setting, "; ")) << ',' << r.usable << ','
        << (r.usable ? "" : CsvQuoted(r.failure)) << ',' << r.pareto;
    for (const std::string& key : keys) {
      out << ',';
      if (const double* value = Find(r, key)) out << *value;
    }
    out << '\n';
  }
  return out.str();
}

std::string SweepText(const SweepReport& report) {
  std::ostringstream out;
  char line[256];
  std::snprintf(line,
                sizeof(line),
                "  %12s %12s %21s",
                "error",
                "cost",
                "least - largest");
  out << "error: " << report.error_key << "; cost: " << report.cost_key << "\n"
      << line;
  for (const WorkColumn& column : WorkColumns()) {
    std::snprintf(line, sizeof(line), " %10s", column.title);
    out << line;
  }
  out << "  setting\n";
  for (const SweepResult* r : CheapestFirst(report)) {
    if (!r->usable) {
      out << "  failed (" << r->failure << ")  " << r->setting.name << "\n";
      continue;
    }
    std::snprintf(line,
                  sizeof(line),
                  "%c %12.4g %12.4g %10.4g %10.4g",
                  r->pareto ? '*' : ' ',
                  r->error,
                  r->cost.median,
                  r->cost.least,
                  r->cost.largest);
    out << line;
    for (const WorkColumn& column : WorkColumns()) {
      std::snprintf(line, sizeof(line), " %10s", WorkText(*r, column).c_str());
      out << line;
    }
    out << "  " << r->setting.name << "\n";
  }
  out << "* no other setting is better in both\n" << VerdictOf(report) << "\n";
  return out.str();
}

}  // namespace invsim
