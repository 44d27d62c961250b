// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/chart.h"

#include <gmock/gmock.h>

#include <cmath>

namespace invsim {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Chart, DrawsFromCornerToCorner) {
  const Chart chart{"height [m]", "time [s]", {0, 1, 2}, {{"h", {0, 1, 4}}}};
  const std::string svg = FormatSvg(chart);
  // Zero at the bottom left, the largest at the top right, a quarter between.
  EXPECT_THAT(svg, HasSubstr("d=\"M58 140L264 111L470 24\""));
  EXPECT_THAT(svg, AllOf(HasSubstr("height [m]"), HasSubstr("time [s]")));
  EXPECT_THAT(svg,
              AllOf(HasSubstr("data-x0=\"0\""), HasSubstr("class=\"curs")));
}

TEST(Chart, LeavesOutWhatCannotBeDrawn) {
  const Chart gap{"t", "x", {0, 1, 2, 3}, {{"y", {1, NAN, 1, INFINITY}}}};
  const std::string svg = FormatSvg(gap);
  EXPECT_THAT(svg, HasSubstr("d=\"M58 24M"));
  EXPECT_THAT(svg, AllOf(Not(HasSubstr("nan")), Not(HasSubstr("inf"))));

  Chart log{"t", "x", {0, 1, 2}, {{"y", {0, 1e-8, 1e-4}}}};
  log.log_y = true;
  EXPECT_THAT(FormatSvg(log),
              AllOf(HasSubstr("d=\"M264 140L470 24\""), HasSubstr(">1e-06<")));
}

TEST(Chart, IsDrawnWithoutValuesOrWithOne) {
  EXPECT_THAT(FormatSvg({}), Not(HasSubstr("nan")));
  EXPECT_THAT(FormatSvg({"t", "x", {3}, {{"y", {0}}}}), Not(HasSubstr("nan")));
}

TEST(Chart, AFileHasAllOneBelowTheOther) {
  const Chart one{"first", "x", {0, 1}, {{"y", {1, 2}}}};
  const Chart two{"second", "x", {0, 1}, {{"y", {2, 1}}}};
  const std::string svg = StandaloneSvg({one, two});
  for (const Chart& chart : {one, two})
    EXPECT_THAT(svg, HasSubstr(FormatSvg(chart).substr(5)));
  EXPECT_THAT(svg,
              AllOf(HasSubstr("viewBox=\"0 0 480 340\">"),
                    HasSubstr("<svg y=\"0\" "),
                    HasSubstr("<svg y=\"170\" "),
                    EndsWith("</svg></svg>\n")));
}

TEST(Chart, EscapesTexts) {
  EXPECT_EQ(EscapeHtml("a<b & \"c\""), "a&lt;b &amp; &quot;c&quot;");
  EXPECT_THAT(FormatSvg({"<script>", "x", {}, {}}), Not(HasSubstr("<script>")));
}

TEST(ShortNumber, KeepsThreeDigits) {
  EXPECT_EQ(ShortNumber(0), "0");
  EXPECT_EQ(ShortNumber(0.012345), "0.0123");
  EXPECT_EQ(ShortNumber(12345), "12345");
  EXPECT_EQ(ShortNumber(1.2345e-7), "1.23e-07");
}

}  // namespace
}  // namespace invsim
