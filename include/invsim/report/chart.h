// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_REPORT_CHART_H_
#define INVSIM_REPORT_CHART_H_

// Line charts as SVG text, for pages that open without a network or scripts.

#include <string>
#include <vector>

namespace invsim {

struct ChartSeries {
  std::string name;
  std::vector<double> values;  // one per entry of x
  std::vector<double> x = {};  // empty: that of the chart
};

struct Chart {
  std::string title;    // with the unit
  std::string x_title;  // with the unit
  std::vector<double> x;
  std::vector<ChartSeries> series;
  bool log_y = false;  // values of zero and less are then left out
  bool log_x = false;  // likewise
};

// An <svg> element. It carries data-x0 and data-x1, the first and last x, and a
// hidden line of class `cursor` for a script to move over it. Values that are
// not finite are left out.
std::string FormatSvg(const Chart& chart);

// Charts one below the other as a file of their own, readable without a page's
// styles.
std::string StandaloneSvg(const std::vector<Chart>& charts);

// Text with & < > " escaped, for HTML and SVG.
std::string EscapeHtml(const std::string& text);

// Three significant digits: "0.0123", "1.23e-07", "12300".
std::string ShortNumber(double value);

}  // namespace invsim

#endif  // INVSIM_REPORT_CHART_H_
