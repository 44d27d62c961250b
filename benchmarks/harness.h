// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_BENCHMARKS_HARNESS_H_
#define INVSIM_BENCHMARKS_HARNESS_H_

// Timing and its tables. Times are processor time, as on a shared machine the
// clock measures the neighbours; and even so one run says little: a time is the
// median of several, and what is claimed are ratios of two things
// measured alternately in one run.

#include <functional>
#include <string>
#include <vector>

namespace invsim {

// One measurement.
struct BenchRow {
  std::string name;  // "step/ratio_to_factorisation"
  int vertices = 0;  // size of the problem; 0: has none
  int contacts = 0;
  double value = 0;
  std::string unit;  // "s", "ratio", "exponent", "MB" ...
};

class Bench {
 public:
  // Only measurements whose name contains `filter` are made. `repeats` samples
  // are taken of each time.
  Bench(std::string filter, int repeats);

  // Whether to measure `name`: ask before building a costly problem.
  bool Wants(const std::string& name) const;
  void Add(BenchRow row) { rows_.push_back(std::move(row)); }
  const std::vector<BenchRow>& rows() const { return rows_; }

  // Seconds of one call of `work`: the median over the repeats, each of as many
  // calls as take 10 ms or more. One call warms up.
  double Seconds(const std::function<void()>& work) const;

  // Seconds(numerator) / Seconds(denominator), as the median of the ratios of
  // pairs of samples taken one right after the other, so that whatever slows
  // the machine down slows both.
  double Ratio(const std::function<void()>& numerator,
               const std::function<void()>& denominator) const;

 private:
  std::string filter_;
  int repeats_;
  std::vector<BenchRow> rows_;
};

// The middle value, or the mean of the two in the middle; of at least one.
double Median(std::vector<double> values);

// p of the law value = c size^p that fits best in logarithms; of at least two
// different sizes, all positive.
double GrowthExponent(const std::vector<double>& sizes,
                      const std::vector<double>& values);

// The largest resident memory the process has had, in megabytes (10^6 bytes).
double PeakMemoryMegabytes();

// For people: a table with a line per row.
std::string BenchTable(const std::vector<BenchRow>& rows);
// For programs: a JSON list of objects with keys name, vertices, contacts,
// value, unit.
std::string BenchJson(const std::vector<BenchRow>& rows);

}  // namespace invsim

#endif  // INVSIM_BENCHMARKS_HARNESS_H_
