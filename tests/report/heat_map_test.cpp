// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/heat_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>

namespace invsim {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

HeatMap MapOf(const std::vector<std::vector<double>>& values) {
  HeatMap map{"title", "x [m]", "y [s]", "steps", {}, {}, values, {}, {}};
  for (const std::vector<double>& row : values) {
    map.y.push_back("y" + std::to_string(map.y.size()));
    map.marks.emplace_back(row.size());
  }
  for (size_t i = 0; i < values[0].size(); ++i)
    map.x.push_back("x" + std::to_string(i));
  return map;
}

// A cell with the number on it, or a line of text, as drawn.
struct DrawnItem {
  double x, y;
  std::string fill, text;
};

std::vector<DrawnItem> CellsOf(const std::string& svg) {
  static const std::regex pattern(
      "<rect x=\"([^\"]+)\" y=\"([^\"]+)\" width=\"[^\"]+\" "
      "height=\"[^\"]+\" fill=\"([^\"]+)\" stroke=\"#fff\"/>"
      "<text [^>]*>([^<]*)</text>");
  std::vector<DrawnItem> cells;
  for (std::sregex_iterator m(svg.begin(), svg.end(), pattern), end; m != end;
       ++m)
    cells.push_back({std::stod((*m)[1]), std::stod((*m)[2]), (*m)[3], (*m)[4]});
  return cells;
}

DrawnItem TextOf(const std::string& svg, const std::string& text) {
  const std::regex pattern("<text x=\"([^\"]+)\" y=\"([^\"]+)\"[^>]*>" + text +
                           "</text>");
  std::smatch m;
  if (!std::regex_search(svg, m, pattern)) {
    ADD_FAILURE() << text << " is not drawn";
    return {};
  }
  return {std::stod(m[1]), std::stod(m[2]), "", text};
}

TEST(HeatMap, RowsGoUpwardsFromTheLowerLeft) {
  const std::string svg = HeatMapSvg(MapOf({{1, 2, 3}, {4, 5, 6}}));
  const std::vector<DrawnItem> cells = CellsOf(svg);
  ASSERT_EQ(cells.size(), 6u);
  for (int k = 0; k < 6; ++k) {
    EXPECT_EQ(cells[k].text, std::to_string(k + 1));
    EXPECT_EQ(cells[k].x, cells[k % 3].x);
    EXPECT_EQ(cells[k].y, cells[k / 3 * 3].y);
  }
  EXPECT_LT(cells[0].x, cells[1].x);
  EXPECT_LT(cells[1].x, cells[2].x);
  EXPECT_GT(cells[0].y, cells[3].y);
  // Labels stand below their columns and left of their rows.
  const double width = cells[1].x - cells[0].x;
  EXPECT_NEAR(TextOf(svg, "x1").x, cells[1].x + width / 2, 1);
  EXPECT_GT(TextOf(svg, "x1").y, cells[0].y);
  EXPECT_LT(TextOf(svg, "y1").x, cells[0].x);
  EXPECT_LT(TextOf(svg, "y1").y, cells[0].y);
  EXPECT_GT(TextOf(svg, "y1").y, cells[3].y);
}

// From the lightest to the darkest; the middle one has the middle colour. A
// number on a dark cell is white.
TEST(HeatMap, ColoursGoByTheLogarithm) {
  const std::string svg = HeatMapSvg(MapOf({{1, 100, 10000}}));
  const std::vector<DrawnItem> cells = CellsOf(svg);
  ASSERT_EQ(cells.size(), 3u);
  EXPECT_EQ(cells[0].fill, "#f7fbff");
  EXPECT_EQ(cells[1].fill, "#6baed6");
  EXPECT_EQ(cells[2].fill, "#08306b");
  EXPECT_THAT(svg, HasSubstr("fill=\"#222\">1<"));
  EXPECT_THAT(svg, HasSubstr("fill=\"#fff\">10000<"));
}

TEST(HeatMap, LegendSaysWhichColourIsHowMuch) {
  const std::string svg = HeatMapSvg(MapOf({{10000, 1}}));
  const DrawnItem least = TextOf(svg, "10"), most = TextOf(svg, "1000"),
                  middle = TextOf(svg, "100");
  EXPECT_EQ(least.x, most.x);
  EXPECT_GT(least.y, middle.y);
  EXPECT_NEAR(middle.y, 0.5 * (least.y + most.y), 1e-9);
}

// And do not change the colours of the others.
TEST(HeatMap, WhatHasNoLogarithmStaysWhite) {
  const std::string svg =
      HeatMapSvg(MapOf({{NAN, 1, INFINITY, 0, -5, 10000, -INFINITY}}));
  const std::vector<DrawnItem> cells = CellsOf(svg);
  ASSERT_EQ(cells.size(), 7u);
  for (const int k : {0, 2, 3, 4, 6}) EXPECT_EQ(cells[k].fill, "#ffffff") << k;
  EXPECT_EQ(cells[1].fill, "#f7fbff");
  EXPECT_EQ(cells[5].fill, "#08306b");
  for (const int k : {0, 2, 6}) EXPECT_EQ(cells[k].text, "") << k;
  EXPECT_EQ(cells[4].text, "-5");
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
}

TEST(HeatMap, IsDrawnOfOneNumberOrNone) {
  for (const double value : {7.0, 0.0, std::nan("")}) {
    const std::string svg = HeatMapSvg(MapOf({{value, value}}));
    EXPECT_EQ(CellsOf(svg).size(), 2u);
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    EXPECT_THAT(svg, Not(HasSubstr("inf")));
  }
}

// Letters on their cells, beside the number, and what they mean below the map.
TEST(HeatMap, MarksStandOnTheirCellsAndAreExplained) {
  HeatMap map = MapOf({{1, 2}, {3, 4}});
  map.marks[1][0] = "E&";
  map.notes = {"E&  energy from <nowhere>", "last"};
  const std::string svg = HeatMapSvg(map);
  const std::vector<DrawnItem> cells = CellsOf(svg);
  const DrawnItem mark = TextOf(svg, "E&amp;");
  EXPECT_GT(mark.x, cells[2].x);
  EXPECT_LT(mark.x, cells[3].x);
  EXPECT_GT(mark.y, cells[2].y);
  EXPECT_LT(mark.y, cells[0].y);
  EXPECT_GT(TextOf(svg, "E&amp;  energy from &lt;nowhere&gt;").y,
            TextOf(svg, "x .m.").y);
  std::smatch height;
  ASSERT_TRUE(
      std::regex_search(svg, height, std::regex("height=\"([0-9.]+)\"")));
  EXPECT_LT(TextOf(svg, "last").y, std::stod(height[1]));
}

}  // namespace
}  // namespace invsim
