// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/hard_map_report.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "invsim/report/chart.h"
#include "invsim/report/heat_map.h"

namespace invsim {
namespace {

using Json = nlohmann::ordered_json;

struct Letter {
  const char* limit;
  char letter;
  const char* words;
};

constexpr Letter kLetters[] = {
    {"finite", 'N', "not finite: the frame has no result"},
    {"converged", 'M', "missed: steps above the contact tolerance, counted"},
    {"penetration", 'P', "penetration of more than 1 mm"},
    {"energy", 'E', "energy from nowhere: more than 1 % of what went about"}};

std::string Marks(const HardOutcome& outcome) {
  std::string marks;
  for (const Letter& letter : kLetters)
    for (const Breach& breach : outcome.broken)
      if (breach.limit == letter.limit) marks += letter.letter;
  return marks;
}

std::string Label(const std::vector<std::string>& labels,
                  const std::vector<double>& values,
                  size_t k) {
  return labels.empty() ? ShortNumber(values[k]) : labels[k];
}

std::string LetterNotes(const HardMapReport& report, const Letter& letter) {
  int cells = 0, all = 0;
  for (const auto& row : report.cells)
    for (const HardMapCell& cell : row) {
      ++all;
      cells += Marks(cell.outcome).find(letter.letter) != std::string::npos;
    }
  return std::string(1, letter.letter) + "  " + letter.words + " (" +
         std::to_string(cells) + " of " + std::to_string(all) + " cells)";
}

}  // namespace

std::string HardMapText(const HardMapReport& report) {
  const HardMap& map = report.map;
  char text[32];
  std::string out = map.shows + "\nalong: " + map.x_title +
                    "; down: " + map.y_title + "\n\n        ";
  for (size_t i = 0; i < map.x.size(); ++i) {
    std::snprintf(
        text, sizeof(text), "%9s", Label(map.x_labels, map.x, i).c_str());
    out += text;
  }
  for (size_t j = map.y.size(); j-- > 0;) {
    std::snprintf(
        text, sizeof(text), "\n%8s", Label(map.y_labels, map.y, j).c_str());
    out += text;
    for (const HardMapCell& cell : report.cells[j]) {
      std::snprintf(text,
                    sizeof(text),
                    "%4.0f %-4s",
                    cell.iterations,
                    Marks(cell.outcome).c_str());
      out += text;
    }
  }
  out += "\n\n";
  for (const Letter& letter : kLetters)
    out += LetterNotes(report, letter) + "\n";
  return out;
}

std::string HardMapJson(const HardMapReport& report) {
  const HardMap& map = report.map;
  Json json;
  json["schema"] = "invsim.map";
  json["schema_version"] = kHardMapSchemaVersion;
  json["name"] = map.name;
  json["shows"] = map.shows;
  json["x_title"] = map.x_title;
  json["y_title"] = map.y_title;
  json["cells"] = Json::array();
  for (size_t j = 0; j < map.y.size(); ++j)
    for (size_t i = 0; i < map.x.size(); ++i) {
      const HardMapCell& cell = report.cells[j][i];
      const HardOutcome& o = cell.outcome;
      Json row;
      row["x"] = map.x[i];
      row["y"] = map.y[j];
      row["iterations_per_step"] = cell.iterations;
      row["substeps"] = o.step.substeps;
      row["substeps_missed"] = o.step.missed;
      row["substeps_halved"] = o.step.halved;
      row["penetration_max_mm"] = 1e3 * o.penetration;
      row["energy_gain_relative"] =
          std::isfinite(o.energy) ? Json(o.energy) : Json();
      row["broken"] = Json::array();
      for (const Breach& breach : o.broken)
        row["broken"].push_back(breach.text);
      json["cells"].push_back(std::move(row));
    }
  return json.dump(2) + "\n";
}

std::string HardMapSvg(const HardMapReport& report) {
  const HardMap& map = report.map;
  HeatMap chart;
  chart.title = map.shows;
  chart.x_title = map.x_title;
  chart.y_title = map.y_title;
  chart.legend = "iterations per step";
  for (size_t i = 0; i < map.x.size(); ++i)
    chart.x.push_back(Label(map.x_labels, map.x, i));
  for (size_t j = 0; j < map.y.size(); ++j)
    chart.y.push_back(Label(map.y_labels, map.y, j));
  for (const auto& row : report.cells) {
    chart.values.emplace_back();
    chart.marks.emplace_back();
    for (const HardMapCell& cell : row) {
      chart.values.back().push_back(cell.iterations);
      chart.marks.back().push_back(Marks(cell.outcome));
    }
  }
  for (const Letter& letter : kLetters)
    chart.notes.push_back(LetterNotes(report, letter));
  return HeatMapSvg(chart);
}

}  // namespace invsim
