// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/run_summary.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "invsim/base/config.h"
#include "invsim/base/error.h"
#include "invsim/io/json_record.h"
#include "text_line.h"

namespace invsim {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Where a figure stands in the report of a fit and of a simulation.
struct Figure {
  const char* name;
  const char* fit;
  const char* simulation;
};

constexpr Figure kFigures[] = {
    {"frames", "inputs.frames", "counts.frames_done"},
    {"initial_cost", "optimization.initial_cost", ""},
    {"cost", "optimization.final_cost", ""},
    {"iterations", "optimization.iterations", ""},
    {"evaluations", "optimization.evaluations", ""},
    {"steps", "simulation.steps", "total.steps"},
    {"steps_missed", "simulation.steps_missed", "total.steps_missed"},
    {"factorizations", "simulation.factorizations", "total.factorizations"},
    {"solves", "simulation.solves", "total.solves"},
    {"penetration_max_mm",
     "final_simulation.penetration_max_mm",
     "total.penetration_max_mm"},
    {"wall_seconds", "wall_seconds", "wall_seconds"},
};

// Of an evaluation that stands beside the report.
constexpr const char* kMetrics[] = {"body_v2v_mean_mm",
                                    "body_tpose_v2v_mean_mm",
                                    "joint_mean_mm",
                                    "cloth_chamfer_l1_mm",
                                    "points_to_surface_mean_mm"};

std::optional<double> Number(const JsonRecord& record, const std::string& key) {
  if (key.empty() || !record.Has(key)) return std::nullopt;
  return record.Number(key, 0);
}

std::map<std::string, std::string> Settings(const fs::path& file) {
  std::map<std::string, std::string> settings;
  if (!fs::exists(file)) return settings;
  const Config config = Config::FromFile(file.string());
  for (const auto& [key, entry] : config.entries())
    settings[key] = TomlText(entry.value);
  return settings;
}

std::string Setting(const RunSummary& run, const std::string& key) {
  const auto found = run.settings.find(key);
  return found == run.settings.end() ? "-" : found->second;
}

// A row of the table: a name and a cell for each run, as wide as its heading.
std::string Row(const std::string& name,
                const std::vector<std::string>& cells,
                const std::vector<int>& widths) {
  std::string row = Line("%-32s", name.c_str());
  for (size_t k = 0; k < cells.size(); ++k)
    row += Line("  %*s", widths[k], cells[k].c_str());
  return row + "\n";
}

// The last part of each folder's path, or all of it where that is not enough to
// tell them apart.
std::vector<std::string> Headings(const std::vector<RunSummary>& runs) {
  std::vector<std::string> all, last;
  for (const RunSummary& run : runs) {
    const fs::path path = fs::path(run.run + "/").lexically_normal();
    all.push_back(path.parent_path().string());
    last.push_back(path.parent_path().filename().string());
  }
  const std::set<std::string> different(last.begin(), last.end());
  return different.size() == runs.size() ? last : all;
}

std::string FigureText(const std::optional<double>& figure) {
  return figure ? Line("%.6g", *figure) : "-";
}

}  // namespace

const std::vector<std::string>& FigureNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Figure& figure : kFigures) all.push_back(figure.name);
    all.insert(all.end(), std::begin(kMetrics), std::end(kMetrics));
    return all;
  }();
  return names;
}

RunSummary ReadRunSummary(const std::string& folder) {
  const fs::path path(folder);
  const std::string file = (path / "report.json").string();
  if (!fs::exists(file))
    throw InputError(folder + ": holds no report.json, as runs do");
  const JsonRecord report = JsonRecord::Read(file);
  RunSummary run{folder,
                 report.Text("schema"),
                 report.Text("status"),
                 report.Text("verdict"),
                 {},
                 Settings(path / "config.resolved.toml")};
  const bool fit = run.schema == "invsim.fit";
  if (!fit && run.schema != "invsim.simulation")
    throw InputError(file + ": schema: expected invsim.fit or " +
                     "invsim.simulation, found '" + run.schema + "'");
  for (const Figure& figure : kFigures)
    run.figures.push_back(Number(report, fit ? figure.fit : figure.simulation));
  const JsonRecord metrics =
      JsonRecord::Read((path / "evaluation.json").string());
  for (const char* key : kMetrics)
    run.figures.push_back(Number(metrics, std::string("metrics.") + key));
  return run;
}

std::vector<std::string> DifferingSettings(
    const std::vector<RunSummary>& runs) {
  std::set<std::string> keys;
  for (const RunSummary& run : runs)
    for (const auto& [key, value] : run.settings) keys.insert(key);
  std::vector<std::string> differing;
  for (const std::string& key : keys)
    if (std::any_of(runs.begin(), runs.end(), [&](const RunSummary& run) {
          return Setting(run, key) != Setting(runs.front(), key);
        }))
      differing.push_back(key);
  return differing;
}

std::string SummaryText(const std::vector<RunSummary>& runs) {
  std::string text;
  const std::vector<std::string> headings = Headings(runs);
  const std::vector<std::string> differing = DifferingSettings(runs);
  std::vector<int> widths;
  for (size_t k = 0; k < runs.size(); ++k) {
    text += runs[k].run + ": " + runs[k].verdict + "\n";
    size_t width = std::max<size_t>(12, headings[k].size());
    for (const std::string& key : differing)
      width = std::max(width, Setting(runs[k], key).size());
    widths.push_back(static_cast<int>(width));
  }
  text += "\n" + Row("", headings, widths);
  const auto add = [&](const std::string& name, const auto& cell) {
    std::vector<std::string> cells;
    for (const RunSummary& run : runs) cells.push_back(cell(run));
    if (std::any_of(cells.begin(), cells.end(), [](const std::string& c) {
          return c != "-";
        }))
      text += Row(name, cells, widths);
  };
  for (size_t k = 0; k < FigureNames().size(); ++k)
    add(FigureNames()[k],
        [&](const RunSummary& run) { return FigureText(run.figures[k]); });
  for (const std::string& key : differing)
    add(key, [&](const RunSummary& run) { return Setting(run, key); });
  return text;
}

std::string SummaryJson(const std::vector<RunSummary>& runs) {
  Json json;
  json["schema"] = "invsim.report";
  json["schema_version"] = 1;
  json["runs"] = Json::array();
  for (const RunSummary& run : runs) {
    Json one;
    one["run"] = run.run;
    one["schema"] = run.schema;
    one["status"] = run.status;
    one["verdict"] = run.verdict;
    one["figures"] = Json::object();
    for (size_t k = 0; k < run.figures.size(); ++k)
      if (run.figures[k]) one["figures"][FigureNames()[k]] = *run.figures[k];
    one["settings"] = Json::object();
    for (const std::string& key : DifferingSettings(runs))
      if (run.settings.contains(key))
        one["settings"][key] = run.settings.at(key);
    json["runs"].push_back(std::move(one));
  }
  // A path may hold any bytes, JSON only UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace invsim
