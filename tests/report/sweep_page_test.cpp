// SPDX-License-Identifier: Apache-2.0
// The table of a sweep's page; verdict and spread are in sweep_report_test.cpp,
// the chart in sweep_chart_test.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "invsim/report/sweep_report.h"

namespace invsim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

SweepResult PageResult(const std::string& name, double error, double cost) {
  SweepResult r;
  r.setting = {name, {{"step.substeps", "4"}, {"scene.friction", "0.5"}}};
  r.usable = true;
  r.error = error;
  r.cost = {cost, cost, cost};
  r.values = {{"error_mm", error}, {"seconds", cost}};
  return r;
}

SweepReport PageSweep(std::vector<SweepResult> results) {
  SweepReport report;
  report.command = "simulate";
  report.error_key = "error_mm";
  report.cost_key = "seconds";
  report.held_against = "reference";
  report.results = std::move(results);
  MarkPareto(&report.results);
  return report;
}

std::vector<std::string> MatchesIn(const std::string& text,
                                   const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> all;
  for (std::sregex_iterator m(text.begin(), text.end(), regex), end; m != end;
       ++m)
    all.push_back((*m)[1]);
  return all;
}

std::vector<std::string> Headings(const std::string& page) {
  return MatchesIn(page, "<th>(.*?)</th>");
}

// The cells of the row of that name, its name the first.
std::vector<std::string> CellsOfRow(const std::string& page,
                                    const std::string& name) {
  const std::vector<std::string> rows =
      MatchesIn(page, "(<tr class=[^]*?)</tr>");
  for (const std::string& row : rows) {
    const std::vector<std::string> cells =
        MatchesIn(row, "<td[^>]*>([^<]*)</td>");
    if (!cells.empty() && cells[0] == name) return cells;
  }
  ADD_FAILURE() << "no row of " << name;
  return {};
}

std::string ClassOfRow(const std::string& page, const std::string& name) {
  const auto found =
      MatchesIn(page, "<tr class=\"(\\w+)\"><td[^>]*>" + name + "</td>");
  return found.empty() ? "no such row" : found[0];
}

TEST(SweepPage, MarksTheParetoFront) {
  SweepReport report = PageSweep({PageResult("good", 1, 8),
                                  PageResult("beaten", 5, 9),
                                  PageResult("fast", 4, 2),
                                  PageResult("broken", 0, 0)});
  report.results[3].usable = false;
  MarkPareto(&report.results);
  const std::string page = SweepHtml(report);
  EXPECT_EQ(ClassOfRow(page, "good"), "front");
  EXPECT_EQ(ClassOfRow(page, "fast"), "front");
  EXPECT_EQ(ClassOfRow(page, "beaten"), "dominated");
  EXPECT_EQ(ClassOfRow(page, "broken"), "failed");
}

TEST(SweepPage, TheCheapestComesFirstAndWhatFailedLast) {
  SweepReport report = PageSweep({PageResult("broken", 1, 0),
                                  PageResult("dear", 1, 8),
                                  PageResult("cheap", 4, 2),
                                  PageResult("middle", 5, 3)});
  report.results[0].usable = false;
  EXPECT_THAT(
      MatchesIn(SweepHtml(report), "<tr class=\"\\w+\"><td[^>]*>(\\w+)</td>"),
      ElementsAre("cheap", "middle", "dear", "broken"));
}

// The error is the first column, and only that.
TEST(SweepPage, NumbersStandUnderTheirKeys) {
  SweepResult more = PageResult("more", 4, 2);
  more.values.emplace_back("sequence.solves", 1201);
  SweepResult other = PageResult("other", 3, 7);
  other.values = {{"sequence.steps", 60}, {"seconds", 7}, {"error_mm", 3}};
  const std::string page = SweepHtml(PageSweep({more, other}));
  EXPECT_THAT(Headings(page),
              ElementsAre("setting",
                          "error_<wbr>mm",
                          "seconds",
                          "sequence.<wbr>solves",
                          "sequence.<wbr>steps"));
  EXPECT_THAT(CellsOfRow(page, "more"),
              ElementsAre("more", "4", "2", "1201", ""));
  EXPECT_THAT(CellsOfRow(page, "other"),
              ElementsAre("other", "3", "7", "", "60"));
}

TEST(SweepPage, WhyARunFailedFillsItsRow) {
  SweepReport report =
      PageSweep({PageResult("good", 1, 8), PageResult("broken", 1, 0)});
  report.results[1].usable = false;
  report.results[1].failure = "a < b & \"c\"";
  const std::string page = SweepHtml(report);
  EXPECT_THAT(CellsOfRow(page, "broken"),
              ElementsAre("broken", "failed: a &lt; b &amp; &quot;c&quot;"));
  EXPECT_THAT(MatchesIn(page, "colspan=\"(\\d+)\""),
              ElementsAre(std::to_string(Headings(page).size() - 1)));
}

TEST(SweepPage, TheErrorHasItsSpreadToo) {
  SweepResult r = PageResult("good", 2, 8);
  r.values.emplace_back("error_mm_least", 1.5);
  r.values.emplace_back("error_mm_largest", 3);
  const std::string page = SweepHtml(PageSweep({r}));
  EXPECT_THAT(CellsOfRow(page, "good"),
              ElementsAre("good", "2 (1.5 to 3)", "8"));
  EXPECT_EQ(Headings(page).size(), 3u);
}

TEST(SweepPage, HoveringOverASettingShowsItsOptions) {
  EXPECT_THAT(SweepHtml(PageSweep({PageResult("good", 1, 8)})),
              HasSubstr("<td title=\"step.substeps = 4\n"
                        "scene.friction = 0.5\">good</td>"));
}

TEST(SweepPage, SaysHowOftenEverySettingRan) {
  SweepReport report = PageSweep({PageResult("good", 1, 8)});
  EXPECT_THAT(SweepHtml(report), HasSubstr("One run each."));
  report.repeats = 3;
  EXPECT_THAT(SweepHtml(report), HasSubstr("Medians of 3 interleaved runs"));
  EXPECT_THAT(SweepHtml(report), Not(HasSubstr("One run each.")));
}

// Names come from the user's files and may hold anything.
TEST(SweepPage, NoNameIsTakenForMarkup) {
  SweepResult r = PageResult("<i>name", 1, 8);
  r.setting.options = {{"scene.garment", "\"<i>option\""}};
  r.values.emplace_back("<i>key", 1);
  SweepReport report = PageSweep({r});
  report.command = "<i>command";
  report.held_against = "<i>truth";
  report.error_key = "<i>error";
  const std::string page = SweepHtml(report);
  EXPECT_THAT(page, Not(HasSubstr("<i>")));
  for (const char* escaped : {"Sweep of &lt;i&gt;command</h1>",
                              "Held against: &lt;i&gt;truth.",
                              "<th>&lt;i&gt;key</th>",
                              "<th>&lt;i&gt;error</th>",
                              "&quot;&lt;i&gt;option&quot;",
                              ">&lt;i&gt;name</td>"})
    EXPECT_THAT(page, HasSubstr(escaped));
}

// It opens from a disk, without a network.
TEST(SweepPage, NeedsNoOtherFile) {
  const std::string page = SweepHtml(PageSweep({PageResult("good", 1, 8)}));
  for (const char* link : {" src=", "href=", "url(", "@import", "<link"})
    EXPECT_THAT(page, Not(HasSubstr(link)));
}

TEST(SweepPage, ASweepOfNothingIsAPage) {
  const std::string page = SweepHtml(PageSweep({}));
  EXPECT_THAT(page, HasSubstr("<p>no setting succeeded</p>"));
  EXPECT_THAT(Headings(page), ElementsAre("setting", "error_<wbr>mm"));
  EXPECT_THAT(page, Not(HasSubstr("nan")));
  EXPECT_THAT(page, HasSubstr("</html>\n"));
}

}  // namespace
}  // namespace invsim
