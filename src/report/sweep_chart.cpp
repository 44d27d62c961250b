// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "invsim/report/chart.h"
#include "sweep_report_parts.h"

namespace invsim {
namespace {

constexpr double kPlotWidth = 720, kPlotHeight = 420;
constexpr double kPlotLeft = 70, kPlotRight = 700, kPlotTop = 30,
                 kPlotBottom = 370;
constexpr char kFront[] = "#0072b2";
constexpr char kDominated[] = "#aaaaaa";
constexpr double kMark = 5;  // radius

// A logarithmic axis. Zero, which it cannot hold, is drawn at its lower end.
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
    if (!(value > 0)) return from_;
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

// "cloth rms [mm]" of cloth_rms_mm.
std::string InWords(const std::string& key) {
  if (key == "cpu_per_simulated_second")
    return "processor time per second simulated [s]";
  if (key == "cpu_seconds") return "processor time [s]";
  if (key == "wall_seconds") return "wall clock [s]";
  std::string words = key, unit;
  for (const auto& [end, name] : {std::pair{"_mm", " [mm]"},
                                  {"_seconds", " [s]"},
                                  {"_m_per_s2", " [m/s2]"}})
    if (words.ends_with(end)) {
      words.resize(words.size() - std::string(end).size());
      unit = name;
    }
  std::replace(words.begin(), words.end(), '_', ' ');
  return words + unit;
}

// Places for words that cover neither marks nor each other.
class Labels {
 public:
  // Nothing is to stand on the mark at (x, y).
  void Keep(double x, double y) {
    taken_.push_back({x - kMark, y + kMark, 2 * kMark});
  }
  // A little above (x, y) if that is free, else the nearest free height.
  double Place(double x, double y, bool to_the_right, const std::string& text) {
    const double width = kLetter * static_cast<double>(text.size());
    Box box{to_the_right ? x : x - width, y, width};
    for (int k = 0; k < kTries && Covered(box); ++k) {
      const int away = k / 2 + 1;
      box.y = y + (k % 2 == 0 ? -away : away) * kHeight;
    }
    taken_.push_back(box);
    return box.y;
  }

 private:
  static constexpr double kLetter = 6.5, kHeight = 13;
  static constexpr int kTries = 12;
  struct Box {
    double x, y, width;
  };

  bool Covered(const Box& box) const {
    return std::any_of(taken_.begin(), taken_.end(), [&](const Box& other) {
      return std::abs(box.y - other.y) < kHeight &&
             box.x < other.x + other.width && other.x < box.x + box.width;
    });
  }

  std::vector<Box> taken_;
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
    Legend();
    Front();
    for (const bool front : {false, true})
      for (const SweepResult& r : report_.results)
        if (Drawable(r) && r.pareto == front) Mark(r);
    Names();
    out_ << "</svg>\n";
    return out_.str();
  }

 private:
  static bool Drawable(const SweepResult& r) {
    return r.usable && r.error >= 0 && r.cost.median > 0;
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
         InWords(report_.cost_key));
    Text(kPlotLeft, kPlotTop - 12, "start", InWords(report_.error_key));
  }

  void Legend() {
    out_ << "<text x=\"" << kPlotRight << "\" y=\"" << kPlotTop - 12
         << "\" text-anchor=\"end\"><tspan fill=\"" << kFront
         << "\">&#9679; on the Pareto front</tspan><tspan dx=\"12\" fill=\""
         << kDominated << "\">&#9679;</tspan> dominated</text>\n";
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
    out_ << "<circle cx=\"" << x << "\" cy=\"" << y << "\" r=\"" << kMark
         << "\" fill=\"" << color << "\"><title>"
         << EscapeHtml(r.setting.name + "\n" + OptionsOf(r.setting, "\n") +
                       "\n" + report_.error_key + " " + ShortNumber(r.error) +
                       "\n" + report_.cost_key + " " +
                       ShortNumber(r.cost.median))
         << "</title></circle>\n";
    labels_.Keep(x, y);
  }

  // Of the settings on the front, with a white rim on what they cross.
  void Names() {
    out_ << "<g paint-order=\"stroke\" stroke=\"white\" stroke-width=\"3\">\n";
    for (const SweepResult& r : report_.results)
      if (Drawable(r) && r.pareto) Name(r);
    out_ << "</g>\n";
  }

  void Name(const SweepResult& r) {
    const double x = x_.At(r.cost.median), y = y_.At(r.error);
    const bool room = x < kPlotLeft + 0.75 * (kPlotRight - kPlotLeft);
    const std::string words = SettingInWords(r.setting);
    const double beside = room ? x + 8 : x - 8;
    Text(beside,
         labels_.Place(beside, y - 8, room, words),
         room ? "start" : "end",
         words);
  }

  const SweepReport& report_;
  Axis x_, y_;
  Labels labels_;
  std::ostringstream out_;
};

}  // namespace

std::string SweepSvg(const SweepReport& report) {
  return SweepDrawing(report).Draw();
}

}  // namespace invsim
