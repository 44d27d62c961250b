// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_REPORT_TEXT_LINE_H_
#define INVSIM_SRC_REPORT_TEXT_LINE_H_

#include <cstdio>
#include <string>

namespace invsim {

// printf into a string: the rows of text tables.
inline std::string Line(const char* format, auto... values) {
  std::string line(std::snprintf(nullptr, 0, format, values...), ' ');
  std::snprintf(line.data(), line.size() + 1, format, values...);
  return line;
}

// A cell of a CSV file.
inline std::string CsvQuoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + "\"";
}

}  // namespace invsim

#endif  // INVSIM_SRC_REPORT_TEXT_LINE_H_
