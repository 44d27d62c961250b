// SPDX-License-Identifier: Apache-2.0
// Where things are on the chart of a sweep; what is on it, and its colours,
// are in sweep_report_test.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <sstream>

#include "invsim/report/sweep_report.h"

namespace invsim {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

SweepResult ResultOf(const std::string& name, double error, SweepSpread cost) {
  SweepResult r;
  r.setting = {name, {{"step.substeps", "1"}}};
  r.usable = true;
  r.error = error;
  r.cost = cost;
  return r;
}

// The chart as drawn, by elements in their order.
class DrawnSweep {
 public:
  explicit DrawnSweep(std::vector<SweepResult> results) {
    SweepReport report;
    report.error_key = "error_mm";
    report.cost_key = "seconds";
    report.results = std::move(results);
    MarkPareto(&report.results);
    svg_ = SweepSvg(report);
  }

  const std::string& svg() const { return svg_; }

  // By its name, which its text for hovering begins with.
  Vector2d Circle(const std::string& name) const {
    return Vector2d(
        Numbers("<circle cx=\"([^\"]+)\" cy=\"([^\"]+)\"[^>]*><title>" + name +
                    "\n",
                2)
            .data());
  }
  Vector2d Text(const std::string& text) const {
    return Vector2d(
        Numbers("<text x=\"([^\"]+)\" y=\"([^\"]+)\"[^>]*>" + text + "</text>",
                2)
            .data());
  }
  // x1, y, x2 of the level bar in this colour.
  std::vector<double> Bar(const std::string& color) const {
    return Numbers(
        "<line x1=\"([^\"]+)\" y1=\"([^\"]+)\" x2=\"([^\"]+)\" "
        "y2=\"\\2\" stroke=\"" +
            color + "\"/>",
        3);
  }
  std::vector<Vector2d> Front() const {
    std::smatch m;
    EXPECT_TRUE(
        std::regex_search(svg_, m, std::regex("<path [^>]* d=\"M([^\"]*)\"")));
    std::string path = m[1];
    std::replace(path.begin(), path.end(), 'L', ' ');
    std::istringstream in(path);
    std::vector<Vector2d> points;
    for (double x, y; in >> x >> y;) points.emplace_back(x, y);
    return points;
  }

 private:
  std::vector<double> Numbers(const std::string& pattern, int count) const {
    std::smatch m;
    const bool found = std::regex_search(svg_, m, std::regex(pattern));
    EXPECT_TRUE(found) << pattern;
    std::vector<double> numbers(count, NAN);
    for (int k = 0; found && k < count; ++k) numbers[k] = std::stod(m[k + 1]);
    return numbers;
  }

  std::string svg_;
};

constexpr double kPixel = 0.01;  // numbers are written in six digits

TEST(SweepChart, BothAxesAreLogarithmic) {
  const DrawnSweep chart({ResultOf("slow", 0.1, {100, 100, 100}),
                          ResultOf("fast", 10, {1, 1, 1}),
                          ResultOf("fair", 1, {10, 10, 10})});
  const Vector2d fast = chart.Circle("fast"), slow = chart.Circle("slow");
  EXPECT_LT(fast.x(), slow.x());
  EXPECT_LT(fast.y(), slow.y());  // large errors are at the top
  EXPECT_LT((chart.Circle("fair") - 0.5 * (fast + slow)).norm(), kPixel);
  // Lines are where their numbers say, and so is what the sweep is about.
  EXPECT_NEAR(chart.Text("10").x(), chart.Circle("fair").x(), kPixel);
  EXPECT_GT(chart.Text("seconds").y(), slow.y());
  EXPECT_LT(chart.Text("error \\[mm\\]").y(), fast.y());
}

TEST(SweepChart, TheFrontRunsFromCheapToDear) {
  const DrawnSweep chart({ResultOf("dear", 1, {8, 8, 8}),
                          ResultOf("beaten", 5, {3, 3, 3}),
                          ResultOf("cheap", 4, {1, 1, 1}),
                          ResultOf("middling", 2, {2, 2, 2})});
  const std::vector<Vector2d> front = chart.Front();
  ASSERT_EQ(front.size(), 3u);
  EXPECT_LT((front[0] - chart.Circle("cheap")).norm(), kPixel);
  EXPECT_LT((front[1] - chart.Circle("middling")).norm(), kPixel);
  EXPECT_LT((front[2] - chart.Circle("dear")).norm(), kPixel);
  // What is beaten must not hide what is not.
  EXPECT_LT(chart.svg().find("<title>beaten"), chart.svg().find("<title>dear"));
}

TEST(SweepChart, BarsReachFromTheLeastToTheLargestCost) {
  const DrawnSweep chart({ResultOf("steady", 1, {30, 30, 30}),
                          ResultOf("beaten", 2, {60, 15, 240})});
  const std::vector<double> bar = chart.Bar("#aaaaaa");
  EXPECT_NEAR(bar[1], chart.Circle("beaten").y(), kPixel);
  // Twice and four times the least, on the way to sixteen times.
  const auto at = [&](double share) {
    return bar[0] + share * (bar[2] - bar[0]);
  };
  EXPECT_NEAR(chart.Circle("steady").x(), at(0.25), kPixel);
  EXPECT_NEAR(chart.Circle("beaten").x(), at(0.5), kPixel);
  // All of it is on the chart.
  EXPECT_GT(bar[0], 70);
  EXPECT_LT(bar[2], 700);
  EXPECT_THAT(chart.svg(), Not(HasSubstr("stroke=\"#0072b2\"/>")));
}

TEST(SweepChart, ASingleResultStandsInTheMiddle) {
  const DrawnSweep chart({ResultOf("only", 3e-5, {2e4, 2e4, 2e4})});
  EXPECT_LT((chart.Circle("only") - Vector2d(385, 200)).norm(), kPixel);
  EXPECT_EQ(chart.Front().size(), 1u);
}

// Where settings crowd, each name keeps a place of its own.
TEST(SweepChart, NamesDoNotCoverEachOther) {
  SweepReport report;
  report.error_key = "cloth_rms_mm";
  report.cost_key = "wall_seconds";
  for (int k = 0; k < 4; ++k) {
    SweepResult r;
    r.setting.name = "setting_of_a_long_name_" + std::to_string(k);
    r.usable = r.pareto = true;
    r.error = 2 - 0.001 * k;
    r.cost = {1 + 0.001 * k, 1 + 0.001 * k, 1 + 0.001 * k};
    report.results.push_back(r);
  }
  const std::string svg = SweepSvg(report);
  const std::regex label("y=\"([^\"]+)\" text-anchor=\"[a-z]+\">setting_of");
  std::vector<double> heights;
  for (std::sregex_iterator m(svg.begin(), svg.end(), label), end; m != end;
       ++m)
    heights.push_back(std::stod((*m)[1]));
  ASSERT_EQ(heights.size(), 4u);
  std::sort(heights.begin(), heights.end());
  for (int k = 0; k < 3; ++k) EXPECT_GE(heights[k + 1] - heights[k], 12);
  EXPECT_NE(svg.find(">cloth rms [mm]<"), std::string::npos);
  EXPECT_NE(svg.find(">wall clock [s]<"), std::string::npos);
}

// Nor do they cover a mark; what lies below a name does not make it illegible.
TEST(SweepChart, NamesKeepOffMarks) {
  const DrawnSweep chart({ResultOf("of_a_long_name", 1, {1, 1, 1}),
                          ResultOf("beaten", 1.02, {1.05, 1.05, 1.05}),
                          ResultOf("dear", 0.5, {2, 2, 2})});
  const Vector2d mark = chart.Circle("beaten");
  const Vector2d name = chart.Text("of_a_long_name");
  ASSERT_GT(mark.x(), name.x());
  ASSERT_LT(mark.x(), name.x() + 80);
  EXPECT_TRUE(name.y() < mark.y() - 5 || name.y() > mark.y() + 13) << name.y();
  EXPECT_GT(chart.svg().find("stroke=\"white\""), chart.svg().rfind("<circle"));
}

TEST(SweepChart, SaysWhatTheColoursMean) {
  const DrawnSweep chart({ResultOf("only", 1, {1, 1, 1})});
  EXPECT_THAT(chart.svg(), HasSubstr(">&#9679; on the Pareto front<"));
  EXPECT_THAT(chart.svg(), HasSubstr("> dominated<"));
}

// The setting that others are held against has none.
TEST(SweepChart, NoErrorIsAtTheLowerEdge) {
  const DrawnSweep chart({ResultOf("exact", 0, {8, 8, 8}),
                          ResultOf("good", 0.1, {4, 4, 4}),
                          ResultOf("poor", 1, {2, 2, 2})});
  EXPECT_NEAR(chart.Circle("exact").y(), 370, kPixel);
  EXPECT_LT(chart.Circle("good").y(), 370);
  EXPECT_EQ(chart.Front().size(), 3u);
  EXPECT_THAT(chart.svg(), HasSubstr("error_mm 0\n"));
}

TEST(SweepChart, HoveringShowsWhatItIsAndCosts) {
  const DrawnSweep chart({ResultOf("a<b", 2.5, {40, 30, 50})});
  EXPECT_THAT(chart.svg(),
              HasSubstr("<title>a&lt;b\nstep.substeps = 1\nerror_mm 2.5\n"
                        "seconds 40</title>"));
}

}  // namespace
}  // namespace invsim
