// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/heat_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <sstream>

#include "invsim/report/chart.h"

namespace invsim {
namespace {

constexpr double kCellWidth = 50, kCellHeight = 34;
constexpr double kMapLeft = 92, kMapTop = 44, kLegend = 120;
constexpr int kLegendSteps = 48;

// Even steps in lightness, told apart in the common kinds of colour blindness
// and in grey.
using Rgb = std::array<double, 3>;
constexpr Rgb kMapColors[] = {{247, 251, 255},
                              {198, 219, 239},
                              {107, 174, 214},
                              {33, 113, 181},
                              {8, 48, 107}};

Rgb ColorAt(double share) {
  constexpr int kLast = static_cast<int>(std::size(kMapColors)) - 1;
  const double at = kLast * std::clamp(share, 0.0, 1.0);
  const int k = std::min(static_cast<int>(at), kLast - 1);
  Rgb color;
  for (int c = 0; c < 3; ++c)
    color[c] =
        (1 - (at - k)) * kMapColors[k][c] + (at - k) * kMapColors[k + 1][c];
  return color;
}

std::string Css(const Rgb& color) {
  char text[8];
  std::snprintf(text,
                sizeof(text),
                "#%02x%02x%02x",
                static_cast<int>(std::lround(color[0])),
                static_cast<int>(std::lround(color[1])),
                static_cast<int>(std::lround(color[2])));
  return text;
}

// Whole from 10 on, two figures below.
std::string InCell(double value) {
  char text[32];
  if (std::abs(value) >= 9.95)
    std::snprintf(text, sizeof(text), "%.0f", value);
  else
    std::snprintf(text, sizeof(text), "%.2g", value);
  return text;
}

bool Drawn(double value) { return std::isfinite(value) && value > 0; }

class MapDrawing {
 public:
  explicit MapDrawing(const HeatMap& map)
      : map_(map),
        right_(kMapLeft + kCellWidth * static_cast<double>(map.x.size())),
        bottom_(kMapTop + kCellHeight * static_cast<double>(map.y.size())) {
    for (const std::vector<double>& row : map.values)
      for (const double value : row)
        if (Drawn(value)) {
          low_ = std::min(low_, std::log10(value));
          high_ = std::max(high_, std::log10(value));
        }
    if (low_ > high_) low_ = high_ = 0;
    if (high_ == low_) high_ = low_ + 1;
  }

  std::string Draw() {
    const double width = right_ + kLegend;
    const double height =
        bottom_ + 58 + 18 * static_cast<double>(map_.notes.size());
    out_ << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << width
         << "\" height=\"" << height << "\" viewBox=\"0 0 " << width << " "
         << height << "\" role=\"img\"><title>" << EscapeHtml(map_.title)
         << "</title><style>text{font:12px sans-serif}.title{font:bold 15px "
            "sans-serif}.mark{font:bold 12px sans-serif}</style>"
            "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>";
    Text(kMapLeft, 24, "start", map_.title, "class=\"title\"");
    for (size_t j = 0; j < map_.y.size(); ++j)
      for (size_t i = 0; i < map_.x.size(); ++i) Cell(i, j);
    Axes();
    Legend();
    for (size_t k = 0; k < map_.notes.size(); ++k)
      Text(kMapLeft,
           bottom_ + 62 + 18 * static_cast<double>(k),
           "start",
           map_.notes[k],
           "");
    out_ << "</svg>\n";
    return out_.str();
  }

 private:
  void Text(double x,
            double y,
            const char* anchor,
            const std::string& text,
            const std::string& more) {
    out_ << "<text x=\"" << x << "\" y=\"" << y << "\" text-anchor=\"" << anchor
         << "\" " << more << ">" << EscapeHtml(text) << "</text>";
  }

  double Share(double value) const {
    return (std::log10(value) - low_) / (high_ - low_);
  }

  void Cell(size_t i, size_t j) {
    const double value = map_.values[j][i];
    const double x = kMapLeft + kCellWidth * static_cast<double>(i);
    const double y = bottom_ - kCellHeight * static_cast<double>(j + 1);
    const std::string color =
        Drawn(value) ? Css(ColorAt(Share(value))) : "#ffffff";
    const bool dark = Drawn(value) && Share(value) > 0.55;
    out_ << "<rect x=\"" << x << "\" y=\"" << y << "\" width=\"" << kCellWidth
         << "\" height=\"" << kCellHeight << "\" fill=\"" << color
         << "\" stroke=\"#fff\"/>";
    const std::string& mark = map_.marks[j][i];
    Text(x + kCellWidth / 2,
         y + (mark.empty() ? 21 : 14),
         "middle",
         std::isfinite(value) ? InCell(value) : "",
         dark ? "fill=\"#fff\"" : "fill=\"#222\"");
    if (mark.empty()) return;
    const double w = 8 + 9 * static_cast<double>(mark.size());
    out_ << "<rect x=\"" << x + (kCellWidth - w) / 2 << "\" y=\"" << y + 17
         << "\" width=\"" << w
         << "\" height=\"14\" rx=\"3\" fill=\"#d55e00\"/>";
    Text(x + kCellWidth / 2,
         y + 28,
         "middle",
         mark,
         "class=\"mark\" fill=\"#fff\"");
  }

  void Axes() {
    for (size_t i = 0; i < map_.x.size(); ++i)
      Text(kMapLeft + kCellWidth * (static_cast<double>(i) + 0.5),
           bottom_ + 17,
           "middle",
           map_.x[i],
           "");
    for (size_t j = 0; j < map_.y.size(); ++j)
      Text(kMapLeft - 7,
           bottom_ - kCellHeight * (static_cast<double>(j) + 0.5) + 4,
           "end",
           map_.y[j],
           "");
    Text((kMapLeft + right_) / 2, bottom_ + 38, "middle", map_.x_title, "");
    std::ostringstream turn;
    turn << "transform=\"rotate(-90 22 " << (kMapTop + bottom_) / 2 << ")\"";
    Text(22, (kMapTop + bottom_) / 2, "middle", map_.y_title, turn.str());
  }

  void Legend() {
    const double x = right_ + 42, step = (bottom_ - kMapTop) / kLegendSteps;
    for (int k = 0; k < kLegendSteps; ++k)
      out_ << "<rect x=\"" << x << "\" y=\"" << bottom_ - step * (k + 1)
           << "\" width=\"16\" height=\"" << step + 0.3 << "\" fill=\""
           << Css(ColorAt((k + 0.5) / kLegendSteps)) << "\"/>";
    out_ << "<rect x=\"" << x << "\" y=\"" << kMapTop
         << "\" width=\"16\" height=\"" << bottom_ - kMapTop
         << "\" fill=\"none\" stroke=\"#888\"/>";
    for (int k = 0; k <= 4; ++k) {
      const double share = 0.25 * k;
      const double value = std::pow(10, low_ + share * (high_ - low_));
      Text(x + 22,
           bottom_ - share * (bottom_ - kMapTop) + 4,
           "start",
           InCell(value),
           "");
    }
    std::ostringstream turn;
    turn << "transform=\"rotate(-90 " << x - 10 << " "
         << (kMapTop + bottom_) / 2 << ")\"";
    Text(x - 10, (kMapTop + bottom_) / 2, "middle", map_.legend, turn.str());
  }

  const HeatMap& map_;
  const double right_, bottom_;
  double low_ = std::numeric_limits<double>::infinity();
  double high_ = -std::numeric_limits<double>::infinity();
  std::ostringstream out_;
};

}  // namespace

std::string HeatMapSvg(const HeatMap& map) { return MapDrawing(map).Draw(); }

}  // namespace invsim
