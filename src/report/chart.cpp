// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/chart.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <sstream>

namespace invsim {
namespace {

// Of the drawing, in its own units.
constexpr double kWidth = 480, kHeight = 170;
constexpr double kLeft = 58, kRight = 470, kTop = 24, kBottom = 140;

// Told apart in the common kinds of colour blindness too.
constexpr const char* kColors[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7"};

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void Take(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  bool empty() const { return low > high; }
  double Share(double value) const { return (value - low) / (high - low); }
};

// What is drawn: the value or its logarithm; NaN is left out.
double Drawn(bool log, double value) {
  if (!std::isfinite(value) || (log && value <= 0)) return NAN;
  return log ? std::log10(value) : value;
}

const std::vector<double>& XOf(const Chart& chart, const ChartSeries& series) {
  return series.x.empty() ? chart.x : series.x;
}

Range YRange(const Chart& chart) {
  Range y;
  for (const ChartSeries& s : chart.series)
    for (const double value : s.values) {
      const double drawn = Drawn(chart.log_y, value);
      if (!std::isnan(drawn)) y.Take(drawn);
    }
  if (y.empty()) return {0, 1};
  if (!chart.log_y) y.Take(0);
  if (y.high - y.low < 1e-12 * std::abs(y.high) || y.high == y.low)
    y.high = y.low + 1;
  return y;
}

Range XRange(const Chart& chart) {
  Range x;
  const auto take = [&](const std::vector<double>& values) {
    for (const double value : values) {
      const double drawn = Drawn(chart.log_x, value);
      if (!std::isnan(drawn)) x.Take(drawn);
    }
  };
  take(chart.x);
  for (const ChartSeries& series : chart.series) take(series.x);
  if (x.empty()) return {0, 1};
  if (x.high == x.low) x.high = x.low + 1;
  return x;
}

class Plot {
 public:
  explicit Plot(const Chart& chart)
      : chart_(chart), x_(XRange(chart)), y_(YRange(chart)) {
    out_.precision(5);
  }

  std::string Draw() {
    out_ << "<svg class=\"chart\" viewBox=\"0 0 " << kWidth << " " << kHeight
         << "\" role=\"img\" data-x0=\"" << x_.low << "\" data-x1=\"" << x_.high
         << "\"><title>" << EscapeHtml(chart_.title) << "</title>";
    Text(kLeft, 14, "start", chart_.title);
    Axes();
    for (size_t k = 0; k < chart_.series.size(); ++k) Series(k);
    if (chart_.series.size() > 1) Legend();
    out_ << "<line class=\"cursor\" x1=\"" << kLeft << "\" x2=\"" << kLeft
         << "\" y1=\"" << kTop << "\" y2=\"" << kBottom << "\" data-left=\""
         << kLeft << "\" data-right=\"" << kRight
         << "\" visibility=\"hidden\"/></svg>";
    return out_.str();
  }

 private:
  double X(double value) const {
    return kLeft + (kRight - kLeft) * x_.Share(value);
  }
  double Y(double drawn) const {
    return kBottom - (kBottom - kTop) * y_.Share(drawn);
  }

  void Text(double x, double y, const char* anchor, const std::string& text) {
    out_ << "<text x=\"" << x << "\" y=\"" << y << "\" text-anchor=\"" << anchor
         << "\">" << EscapeHtml(text) << "</text>";
  }

  void Axes() {
    for (int k = 0; k <= 2; ++k) {
      const double drawn = y_.low + 0.5 * k * (y_.high - y_.low);
      out_ << "<line class=\"grid\" x1=\"" << kLeft << "\" x2=\"" << kRight
           << "\" y1=\"" << Y(drawn) << "\" y2=\"" << Y(drawn) << "\"/>";
      Text(kLeft - 5,
           Y(drawn) + 4,
           "end",
           ShortNumber(chart_.log_y ? std::pow(10, drawn) : drawn));
    }
    const auto x_text = [this](double drawn) {
      return ShortNumber(chart_.log_x ? std::pow(10, drawn) : drawn);
    };
    Text(kLeft, kBottom + 15, "start", x_text(x_.low));
    Text(kRight, kBottom + 15, "end", x_text(x_.high));
    Text(0.5 * (kLeft + kRight), kBottom + 15, "middle", chart_.x_title);
  }

  void Series(size_t k) {
    const ChartSeries& series = chart_.series[k];
    out_ << "<path fill=\"none\" stroke=\"" << kColors[k % 4]
         << "\" stroke-width=\"1.5\" d=\"";
    bool pen_down = false;
    const std::vector<double>& all_x = XOf(chart_, series);
    const size_t n = std::min(all_x.size(), series.values.size());
    for (size_t i = 0; i < n; ++i) {
      const double x = Drawn(chart_.log_x, all_x[i]);
      const double y = Drawn(chart_.log_y, series.values[i]);
      if (std::isnan(x) || std::isnan(y)) {
        pen_down = false;
        continue;
      }
      out_ << (pen_down ? "L" : "M") << X(x) << " " << Y(y);
      pen_down = true;
    }
    out_ << "\"/>";
  }

  void Legend() {
    double x = kRight;
    for (size_t k = chart_.series.size(); k-- > 0;) {
      out_ << "<text x=\"" << x << "\" y=\"14\" text-anchor=\"end\" style=\""
           << "fill:" << kColors[k % 4] << "\">"
           << EscapeHtml(chart_.series[k].name) << "</text>";
      x -= 14 + 6.5 * static_cast<double>(chart_.series[k].name.size());
    }
  }

  const Chart& chart_;
  const Range x_, y_;
  std::ostringstream out_;
};

}  // namespace

std::string FormatSvg(const Chart& chart) { return Plot(chart).Draw(); }

std::string StandaloneSvg(const std::vector<Chart>& charts) {
  std::ostringstream out;
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"960\" "
      << "viewBox=\"0 0 " << kWidth << " " << kHeight * charts.size() << "\">"
      << "<style>text{font:11px sans-serif}.grid{stroke:#ddd}</style>"
      << "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>";
  const std::string open = "<svg ";
  for (size_t k = 0; k < charts.size(); ++k)
    out << open << "y=\"" << kHeight * k << "\" width=\"" << kWidth
        << "\" height=\"" << kHeight << "\" "
        << FormatSvg(charts[k]).substr(open.size());
  out << "</svg>\n";
  return out.str();
}

std::string EscapeHtml(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string ShortNumber(double value) {
  char text[32];
  const bool plain =
      value == 0 || (std::abs(value) >= 1000 && std::abs(value) < 1e6);
  std::snprintf(text, sizeof(text), plain ? "%.0f" : "%.3g", value);
  return text;
}

}  // namespace invsim
