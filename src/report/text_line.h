// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_REPORT_TEXT_LINE_H_
#define INVSIM_SRC_REPORT_TEXT_LINE_H_

#include <cstdio>
#include <string>

namespace invsim {

// printf into a string of at most 400 characters: the rows of text tables.
inline std::string Line(const char* format, auto... values) {
  char line[400];
  std::snprintf(line, sizeof(line), format, values...);
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
