// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/sweep_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "invsim/report/chart.h"

namespace invsim {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kPlotWidth = 720, kPlotHeight = 420;
constexpr double kPlotLeft = 70, kPlotRight = 700, kPlotTop = 30,
                 kPlotBottom = 370;
constexpr char kFront[] = "#0072b2";
constexpr char kDominated[] = "#aaaaaa";
// Of the keys of a spread.
constexpr char kLeast[] = "_least";
constexpr char kLargest[] = "_largest";

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

std::string CsvQuoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + "\"";
}

// A logarithmic axis.
class Axis {
 public:
  Axis(double from, double to) : from_(from), to_(to) {}
  void Take(double value) {
    if (!(value > 0) || !std::isfinite(value)) return;
    low_ = std::min(low_, value);
    high_ = std::max(high_, value);
  }
  // Some room at both ends.
  void Finish() {
    if (low_ > high_) low_ = high_ = 1;
    const double room = std::max(1.15, std::pow(high_ / low_, 0.06));
    low_ /= room;
    high_ *= room;
  }
  double At(double value) const {
    const double share = std::log(value / low_) / std::log(high_ / low_);
    return from_ + (to_ - from_) * share;
  }
  // 1, 2 and 5 times powers of ten within it; all whole multiples, or halves
  // too, where those are few.
  std::vector<double> Ticks() const {
    std::vector<double> ticks;
    for (const auto& multiples : {std::vector<double>{1, 2, 5},
                                  {1, 2, 3, 4, 5, 6, 7, 8, 9},
                                  {1,
                                   1.2,
                                   1.5,
                                   2,
                                   2.5,
                                   3,
                                   3.5,
                                   4,
                                   4.5,
                                   5,
                                   5.5,
                                   6,
                                   6.5,
                                   7,
                                   7.5,
                                   8,
                                   8.5,
                                   9,
                                   9.5}}) {
      ticks = Within(multiples);
      if (ticks.size() >= kFewestTicks) break;
    }
    return ticks;
  }

 private:
  static constexpr size_t kFewestTicks = 4;

  // What there is of these multiples of powers of ten.
  std::vector<double> Within(const std::vector<double>& multiples) const {
    std::vector<double> ticks;
    for (int e = static_cast<int>(std::floor(std::log10(low_)));
         std::pow(10, e) <= high_;
         ++e)
      for (const double m : multiples)
        if (m * std::pow(10, e) >= low_ && m * std::pow(10, e) <= high_)
          ticks.push_back(m * std::pow(10, e));
    return ticks;
  }

  double from_, to_;
  double low_ = std::numeric_limits<double>::infinity();
  double high_ = 0;
};

class SweepDrawing {
 public:
  explicit SweepDrawing(const SweepReport& report)
      : report_(report), x_(kPlotLeft, kPlotRight), y_(kPlotBottom, kPlotTop) {
    out_.precision(6);
    for (const SweepResult& r : report.results) {
      if (!Drawable(r)) continue;
      x_.Take(r.cost.least);
      x_.Take(r.cost.largest);
      y_.Take(r.error);
    }
    x_.Finish();
    y_.Finish();
  }

  std::string Draw() {
    out_ << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 "
         << kPlotWidth << ' ' << kPlotHeight
         << "\" font-family=\"sans-serif\" font-size=\"12\">\n"
         << "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
    Axes();
    Front();
    for (const bool front : {false, true})
      for (const SweepResult& r : report_.results)
        if (Drawable(r) && r.pareto == front) Mark(r);
    out_ << "</svg>\n";
    return out_.str();
  }

 private:
  static bool Drawable(const SweepResult& r) {
    return r.usable && r.error > 0 && r.cost.median > 0;
  }

  void Text(double x, double y, const char* anchor, const std::string& text) {
    out_ << "<text x=\"" << x << "\" y=\"" << y << "\" text-anchor=\"" << anchor
         << "\">" << EscapeHtml(text) << "</text>\n";
  }
  void Line(double x0, double y0, double x1, double y1, const char* color) {
    out_ << "<line x1=\"" << x0 << "\" y1=\"" << y0 << "\" x2=\"" << x1
         << "\" y2=\"" << y1 << "\" stroke=\"" << color << "\"/>\n";
  }

  void Axes() {
    for (const double tick : x_.Ticks()) {
      Line(x_.At(tick), kPlotTop, x_.At(tick), kPlotBottom, "#eeeeee");
      Text(x_.At(tick), kPlotBottom + 16, "middle", ShortNumber(tick));
    }
    for (const double tick : y_.Ticks()) {
      Line(kPlotLeft, y_.At(tick), kPlotRight, y_.At(tick), "#eeeeee");
      Text(kPlotLeft - 6, y_.At(tick) + 4, "end", ShortNumber(tick));
    }
    Text(0.5 * (kPlotLeft + kPlotRight),
         kPlotBottom + 38,
         "middle",
         report_.cost_key);
    Text(kPlotLeft, kPlotTop - 12, "start", report_.error_key);
  }

  void Front() {
    out_ << "<path fill=\"none\" stroke=\"" << kFront
         << "\" stroke-width=\"1.5\" d=\"";
    char command = 'M';
    for (const SweepResult* r : CheapestFirst(report_)) {
      if (!Drawable(*r) || !r->pareto) continue;
      out_ << command << x_.At(r->cost.median) << ' ' << y_.At(r->error);
      command = 'L';
    }
    out_ << "\"/>\n";
  }

  void Mark(const SweepResult& r) {
    const char* color = r.pareto ? kFront : kDominated;
    const double x = x_.At(r.cost.median), y = y_.At(r.error);
    if (r.cost.least < r.cost.largest)
      Line(x_.At(r.cost.least), y, x_.At(r.cost.largest), y, color);
    out_ << "<circle cx=\"" << x << "\" cy=\"" << y << "\" r=\"5\" fill=\""
         << color << "\"><title>"
         << EscapeHtml(r.setting.name + "\n" + OptionsOf(r.setting, "\n") +
                       "\n" + report_.error_key + " " + ShortNumber(r.error) +
                       "\n" + report_.cost_key + " " +
                       ShortNumber(r.cost.median))
         << "</title></circle>\n";
    if (!r.pareto) return;
    const bool room = x < kPlotLeft + 0.75 * (kPlotRight - kPlotLeft);
    Text(room ? x + 8 : x - 8,
         y - 8,
         room ? "start" : "end",
         SettingInWords(r.setting));
  }

  const SweepReport& report_;
  Axis x_, y_;
  std::ostringstream out_;
};

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

// Solver work: it carries over to other machines as seconds do not.
struct WorkColumn {
  const char* title;
  std::vector<std::string> keys;  // the first that there is
};
const std::vector<WorkColumn>& WorkColumns() {
  static const std::vector<WorkColumn> columns = {
      {"factoris.", {"total.factorizations", "simulation.factorizations"}},
      {"solves", {"total.solves", "simulation.solves"}},
      {"queries", {"total.contact_queries", "simulation.contact_queries"}}};
  return columns;
}

std::string WorkText(const SweepResult& r, const WorkColumn& column) {
  for (const std::string& key : column.keys)
    if (const double* value = Find(r, key)) return ShortNumber(*value);
  return "-";
}

std::string VerdictOf(const SweepReport& report) {
  const bool time = report.cost_key.find("second") != std::string::npos;
  return SweepVerdict(report.results, report.tolerance, time ? "time" : "cost");
}

// "1.2", or "1.2 (1.1 to 1.5)" over repeats that differ.
std::string SpreadText(const SweepResult& r, const std::string& key) {
  const double* value = Find(r, key);
  if (!value) return "";
  const double* least = Find(r, key + kLeast);
  const double* largest = Find(r, key + kLargest);
  if (!least || !largest) return ShortNumber(*value);
  return ShortNumber(*value) + " (" + ShortNumber(*least) + " to " +
         ShortNumber(*largest) + ")";
}

bool EndsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() &&
         text.compare(text.size() - end.size(), end.size(), end) == 0;
}

// A long key may be broken after any of its words.
std::string Breakable(const std::string& key) {
  std::string text;
  for (const char c : key) {
    text += EscapeHtml(std::string(1, c));
    if (c == '_' || c == '.') text += "<wbr>";
  }
  return text;
}

void WriteTable(const SweepReport& report, std::ostream* out) {
  std::vector<std::string> keys = ValueKeys(report);
  std::erase_if(keys, [&](const std::string& key) {
    return key == report.error_key || EndsWith(key, kLeast) ||
           EndsWith(key, kLargest);
  });
  *out << "<div><table><tr><th>setting</th><th>" << Breakable(report.error_key)
       << "</th>";
  for (const std::string& key : keys)
    *out << "<th>" << Breakable(key) << "</th>";
  *out << "</tr>\n";
  for (const SweepResult* r : CheapestFirst(report)) {
    *out << "<tr class=\""
         << (!r->usable  ? "failed"
             : r->pareto ? "front"
                         : "dominated")
         << "\"><td title=\"" << EscapeHtml(OptionsOf(r->setting, "\n"))
         << "\">" << EscapeHtml(r->setting.name) << "</td>";
    if (r->usable) {
      *out << "<td>" << SpreadText(*r, report.error_key) << "</td>";
      for (const std::string& key : keys)
        *out << "<td>" << SpreadText(*r, key) << "</td>";
    } else {
      *out << "<td class=\"why\" colspan=\"" << keys.size() + 1 << "\">"
           << EscapeHtml("failed: " + r->failure) << "</td>";
    }
    *out << "</tr>\n";
  }
  *out << "</table></div>\n";
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
  out << "name,options,usable,pareto";
  for (const std::string& key : keys) out << ',' << key;
  out << '\n';
  for (const SweepResult& r : report.results) {
    out << CsvQuoted(r.setting.name) << ','
        << CsvQuoted(OptionsOf(r.setting, "; ")) << ',' << r.usable << ','
        << r.pareto;
    for (const std::string& key : keys) {
      out << ',';
      if (const double* value = Find(r, key)) out << *value;
    }
    out << '\n';
  }
  return out.str();
}

std::string SweepSvg(const SweepReport& report) {
  return SweepDrawing(report).Draw();
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

std::string SweepHtml(const SweepReport& report) {
  std::ostringstream out;
  out << "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
         "<title>invsim sweep</title><style>"
         "body{font-family:sans-serif;max-width:75em;margin:1em auto;"
         "padding:0 1em}h1{font-size:1.3rem}"
         "svg{width:100%;max-width:60em}div{overflow-x:auto}"
         "table{border-collapse:collapse;font-size:85%}"
         "td,th{padding:.2em .6em;text-align:right;border-bottom:1px solid "
         "#ddd}th{vertical-align:bottom}td{white-space:nowrap}"
         "td:first-child,th:first-child,.why{text-align:left}"
         ".dominated{color:#888}.failed{color:#a00}"
         "</style></head><body>\n<h1>Sweep of "
      << EscapeHtml(report.command) << "</h1>\n<p>"
      << EscapeHtml(VerdictOf(report))
      << "</p>\n<p>Held against: " << EscapeHtml(report.held_against) << ". "
      << (report.repeats > 1
              ? "Medians of " + std::to_string(report.repeats) +
                    " interleaved runs, with the least and the largest."
              : "One run each.")
      << "</p>\n"
      << SweepSvg(report);
  WriteTable(report, &out);
  out << "</body></html>\n";
  return out.str();
}

}  // namespace invsim
