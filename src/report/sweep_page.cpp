// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <sstream>

#include "invsim/report/chart.h"
#include "sweep_report_parts.h"

namespace invsim {
namespace {

// Of the keys of a spread.
constexpr char kLeast[] = "_least";
constexpr char kLargest[] = "_largest";

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
