// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/evaluation_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "invsim/report/chart.h"
#include "text_line.h"

namespace invsim {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMillimetresPerCentimetre = 10;

// What a row of the results table shows of a frame.
struct Row {
  const char* name;
  ChamferDistance FrameMetrics::*member;
};
constexpr Row kRows[] = {{"body", &FrameMetrics::body_chamfer},
                         {"cloth", &FrameMetrics::cloth_chamfer},
                         {"combined", &FrameMetrics::combined_chamfer}};

struct Spread {
  int count = 0;
  double mean = 0, deviation = 0;  // mm
};

Spread SpreadOf(const std::vector<RunEvaluation>& evaluations,
                const std::string& garment,
                const Row& row) {
  std::vector<double> values;
  for (const RunEvaluation& e : evaluations) {
    if (e.garment != garment) continue;
    for (const FrameMetrics& f : e.metrics.frames)
      if (!std::isnan((f.*row.member).mean()))
        values.push_back((f.*row.member).mean());
  }
  Spread s;
  s.count = static_cast<int>(values.size());
  if (values.empty()) return s;
  for (const double v : values) s.mean += v / s.count;
  double square = 0;
  for (const double v : values) square += (v - s.mean) * (v - s.mean);
  if (s.count > 1) s.deviation = std::sqrt(square / (s.count - 1));
  return s;
}

std::vector<std::string> Garments(
    const std::vector<RunEvaluation>& evaluations) {
  std::vector<std::string> names;
  for (const RunEvaluation& e : evaluations)
    if (std::find(names.begin(), names.end(), e.garment) == names.end())
      names.push_back(e.garment);
  return names;
}

std::string Centimetres(double millimetres) {
  char text[32];
  std::snprintf(
      text, sizeof(text), "%.2f", millimetres / kMillimetresPerCentimetre);
  return text;
}

Json MetricsJson(const Metrics& metrics) {
  Json json = Json::object();
  for (const auto& [key, value] : metrics.Values()) json[key] = value;
  return json;
}

Json FrameJson(const FrameMetrics& m) {
  Json json;
  const auto add = [&](const char* key, double value) {
    if (!std::isnan(value)) json[key] = value;
  };
  add("body_v2v_mean_mm", m.body_v2v);
  add("joint_mean_mm", m.joint);
  add("body_chamfer_l1_mm", m.body_chamfer.mean());
  add("cloth_v2v_mean_mm", m.cloth_v2v);
  add("cloth_chamfer_l1_mm", m.cloth_chamfer.mean());
  add("combined_chamfer_l1_mm", m.combined_chamfer.mean());
  add("points_to_surface_mean_mm", m.points_to_surface);
  add("penetration_max_mm", m.penetration);
  return json;
}

std::string Dump(const Json& json) {
  // A path may hold any bytes, JSON only UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json Head(const RunEvaluation& e) {
  Json json;
  json["run"] = e.run;
  json["truth"] = e.truth;
  json["garment"] = e.garment;
  json["frames_compared"] = e.metrics.frames.size();
  json["metrics"] = MetricsJson(e.metrics);
  return json;
}

}  // namespace

const std::vector<PublishedResult>& PublishedResults() {
  static const std::vector<PublishedResult> results = {
      {"body", 33, 37}, {"cloth", 21, 28}, {"combined", 29, 31}};
  return results;
}

std::string EvaluationJson(const RunEvaluation& e) {
  Json json;
  json["schema"] = "invsim.evaluation";
  json["schema_version"] = kEvaluationSchemaVersion;
  json.update(Head(e));
  json["frames"] = Json::array();
  for (const FrameMetrics& f : e.metrics.frames)
    json["frames"].push_back(FrameJson(f));
  return Dump(json);
}

std::string EvaluationsJson(const std::vector<RunEvaluation>& evaluations) {
  Json json;
  json["schema"] = "invsim.evaluations";
  json["schema_version"] = kEvaluationSchemaVersion;
  json["runs"] = Json::array();
  for (const RunEvaluation& e : evaluations) json["runs"].push_back(Head(e));
  json["table"] = Json::array();
  for (const std::string& garment : Garments(evaluations)) {
    for (const Row& row : kRows) {
      const Spread s = SpreadOf(evaluations, garment, row);
      if (s.count == 0) continue;
      json["table"].push_back({{"garment", garment},
                               {"row", row.name},
                               {"frames", s.count},
                               {"chamfer_l1_mean_mm", s.mean},
                               {"chamfer_l1_deviation_mm", s.deviation}});
    }
  }
  return Dump(json);
}

std::string EvaluationText(const RunEvaluation& e) {
  std::ostringstream out;
  for (const auto& [key, value] : e.metrics.Values()) {
    char line[96];
    std::snprintf(line, sizeof(line), "%-42s %10.4f\n", key.c_str(), value);
    out << line;
  }
  return out.str();
}

std::string EvaluationsCsv(const std::vector<RunEvaluation>& evaluations) {
  std::vector<std::string> keys;
  for (const RunEvaluation& e : evaluations)
    for (const auto& [key, value] : e.metrics.Values())
      if (std::find(keys.begin(), keys.end(), key) == keys.end())
        keys.push_back(key);
  std::ostringstream out;
  out.precision(9);
  out << "run,truth,garment";
  for (const std::string& key : keys) out << ',' << key;
  out << '\n';
  for (const RunEvaluation& e : evaluations) {
    out << CsvQuoted(e.run) << ',' << CsvQuoted(e.truth) << ','
        << CsvQuoted(e.garment);
    const auto values = e.metrics.Values();
    for (const std::string& key : keys) {
      out << ',';
      for (const auto& [name, value] : values)
        if (name == key) out << value;
    }
    out << '\n';
  }
  return out.str();
}

std::string ResultsTable(const std::vector<RunEvaluation>& evaluations) {
  const std::vector<std::string> garments = Garments(evaluations);
  std::ostringstream out;
  out << "| Chamfer, cm |";
  for (const std::string& garment : garments) out << ' ' << garment << " |";
  out << " published, other data [1] |\n|---|";
  for (size_t k = 0; k <= garments.size(); ++k) out << "---|";
  out << '\n';
  for (const Row& row : kRows) {
    out << "| " << row.name << " |";
    for (const std::string& garment : garments) {
      const Spread s = SpreadOf(evaluations, garment, row);
      if (s.count == 0) {
        out << " - |";
      } else {
        out << ' ' << Centimetres(s.mean) << " ± " << Centimetres(s.deviation)
            << " |";
      }
    }
    for (const PublishedResult& p : PublishedResults())
      if (std::string(p.row) == row.name)
        out << ' ' << Centimetres(p.low) << " to " << Centimetres(p.high)
            << " |";
    out << '\n';
  }
  out << "\nMean ± standard deviation over all frames; the mean of both "
         "directions, unsquared.\n"
         "[1] Means that Guo, Li, Narain and Park (CVPR 2021) report for their "
         "own bodies,\n    garments and motions: another data set, so no more "
         "than the order of size compares.\n";
  return out.str();
}

}  // namespace invsim
