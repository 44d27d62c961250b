// SPDX-License-Identifier: Apache-2.0
#include "invsim/base/names.h"

#include <algorithm>

namespace invsim {
namespace {

char Fold(char c) {
  if (c >= 'A' && c <= 'Z') return static_cast<char>(c - 'A' + 'a');
  return c == '-' ? '_' : c;
}

std::string_view LastPart(std::string_view name) {
  const size_t dot = name.rfind('.');
  return dot == std::string_view::npos ? name : name.substr(dot + 1);
}

// More edits than this and the suggestion would be a guess.
int Tolerance(std::string_view name) {
  return std::max<int>(1, static_cast<int>(name.size()) / 3);
}

}  // namespace

int EditDistance(std::string_view a, std::string_view b) {
  // Rows i - 2, i - 1 and i of the table of distances between prefixes.
  const size_t n = b.size();
  std::vector<int> before(n + 1), last(n + 1), row(n + 1);
  for (size_t j = 0; j <= n; ++j) row[j] = static_cast<int>(j);
  for (size_t i = 1; i <= a.size(); ++i) {
    std::swap(before, last);
    std::swap(last, row);
    row[0] = static_cast<int>(i);
    for (size_t j = 1; j <= n; ++j) {
      const bool same = Fold(a[i - 1]) == Fold(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + !same});
      if (i > 1 && j > 1 && Fold(a[i - 1]) == Fold(b[j - 2]) &&
          Fold(a[i - 2]) == Fold(b[j - 1]))
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[n];
}

std::string NearestName(std::string_view name,
                        const std::vector<std::string>& names) {
  std::string nearest;
  int smallest = Tolerance(name) + 1;
  for (const std::string& candidate : names) {
    // A full match of the last part alone is as good as one wrong letter.
    int distance = EditDistance(name, candidate);
    if (candidate.find('.') != std::string::npos)
      distance = std::min(
          distance, 1 + EditDistance(LastPart(name), LastPart(candidate)));
    if (distance < smallest) {
      smallest = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string UnknownName(std::string_view kind,
                        std::string_view name,
                        const std::vector<std::string>& names) {
  std::string text = "unknown ";
  text.append(kind).append(" '").append(name).append("'");
  const std::string nearest = NearestName(name, names);
  if (!nearest.empty()) return text + "; did you mean '" + nearest + "'?";
  if (names.empty()) return text + "; none is known";
  return text + "; known: " + Join(names);
}

std::string Join(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) {
    if (!text.empty()) text += ", ";
    text += part;
  }
  return text;
}

}  // namespace invsim
