// SPDX-License-Identifier: Apache-2.0
#include "harness.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "invsim/base/stopwatch.h"

namespace invsim {
namespace {

using Work = std::function<void()>;

// Seconds of one call out of `calls`.
double Sample(const Work& work, int calls) {
  const ProcessorStopwatch watch;
  for (int i = 0; i < calls; ++i) work();
  return watch.seconds() / calls;
}

// Warms up and tells how many calls a sample needs to be long enough.
int CallsPerSample(const Work& work) {
  constexpr double kLongEnough = 0.01;
  const double seconds = Sample(work, 1);
  if (seconds >= kLongEnough) return 1;
  return static_cast<int>(std::ceil(kLongEnough / std::max(seconds, 1e-8)));
}

}  // namespace

Bench::Bench(std::string filter, int repeats)
    : filter_(std::move(filter)), repeats_(repeats) {}

bool Bench::Wants(const std::string& name) const {
  return name.find(filter_) != std::string::npos;
}

double Bench::Seconds(const Work& work) const {
  const int calls = CallsPerSample(work);
  std::vector<double> samples;
  for (int i = 0; i < repeats_; ++i) samples.push_back(Sample(work, calls));
  return Median(std::move(samples));
}

double Bench::Ratio(const Work& numerator, const Work& denominator) const {
  const int numerator_calls = CallsPerSample(numerator);
  const int denominator_calls = CallsPerSample(denominator);
  std::vector<double> ratios;
  for (int i = 0; i < repeats_; ++i) {
    const double above = Sample(numerator, numerator_calls);
    ratios.push_back(above / Sample(denominator, denominator_calls));
  }
  return Median(std::move(ratios));
}

double Median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  if (values.size() % 2 == 1) return values[half];
  return 0.5 * (values[half - 1] + values[half]);
}

double GrowthExponent(const std::vector<double>& sizes,
                      const std::vector<double>& values) {
  const auto n = static_cast<double>(sizes.size());
  double mean_x = 0;
  double mean_y = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    mean_x += std::log(sizes[i]) / n;
    mean_y += std::log(values[i]) / n;
  }
  double xx = 0;
  double xy = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const double x = std::log(sizes[i]) - mean_x;
    xx += x * x;
    xy += x * (std::log(values[i]) - mean_y);
  }
  return xy / xx;
}

double PeakMemoryMegabytes() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return 1024e-6 * static_cast<double>(usage.ru_maxrss);  // Linux: kilobytes
}

std::string BenchTable(const std::vector<BenchRow>& rows) {
  std::size_t width = 4;
  for (const BenchRow& row : rows) width = std::max(width, row.name.size());
  std::string table;
  const auto add_line = [&](const std::string& name,
                            const std::string& vertices,
                            const std::string& contacts,
                            const std::string& value) {
    char line[64];
    std::snprintf(
        line, sizeof(line), "  %9s  %9s  ", vertices.c_str(), contacts.c_str());
    table += name + std::string(width - name.size(), ' ') + line + value + "\n";
  };
  add_line("name", "vertices", "contacts", "value");
  for (const BenchRow& row : rows) {
    char value[32];
    std::snprintf(value, sizeof(value), "%.4g ", row.value);
    add_line(row.name,
             row.vertices > 0 ? std::to_string(row.vertices) : "-",
             row.contacts > 0 ? std::to_string(row.contacts) : "-",
             value + row.unit);
  }
  return table;
}

std::string BenchJson(const std::vector<BenchRow>& rows) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const BenchRow& row : rows) {
    list.push_back({{"name", row.name},
                    {"vertices", row.vertices},
                    {"contacts", row.contacts},
                    {"value", row.value},
                    {"unit", row.unit}});
  }
  return list.dump(2) + "\n";
}

}  // namespace invsim
