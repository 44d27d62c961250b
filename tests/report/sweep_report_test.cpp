// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/sweep_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace invsim {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

SweepReport ExampleSweep() {
  SweepReport report;
  report.command = "simulate";
  report.error_key = "error_mm";
  report.cost_key = "seconds";
  report.held_against = "the reference run";
  const auto add = [&](const char* name, double error, double cost) {
    SweepResult r;
    r.setting = {name, {{"step.substeps", "\"<" + std::string(name) + ">\""}}};
    r.usable = error > 0;
    r.failure = r.usable ? "" : "it broke";
    r.exit_codes = {r.usable ? 0 : 5};
    r.error = error;
    r.cost = {cost, 0.9 * cost, 1.2 * cost};
    if (r.usable) r.values = {{"error_mm", error}, {"seconds", cost}};
    report.results.push_back(r);
  };
  add("good", 1, 8);
  add("fast", 4, 1);
  add("beaten", 5, 2);
  add("broken", 0, 0);
  MarkPareto(&report.results);
  return report;
}

size_t Count(const std::string& text, const std::string& part) {
  size_t count = 0;
  for (size_t at = text.find(part); at != std::string::npos;
       at = text.find(part, at + 1))
    ++count;
  return count;
}

TEST(SweepReport, KeepsFailuresAsResults) {
  const auto json = nlohmann::json::parse(SweepJson(ExampleSweep()));
  ASSERT_EQ(json["results"].size(), 4u);
  EXPECT_EQ(json["results"][3]["usable"], false);
  EXPECT_EQ(json["results"][3]["exit_codes"][0], 5);
  EXPECT_EQ(json["results"][3]["failure"], "it broke");
  EXPECT_EQ(json["results"][1]["pareto"], true);
  EXPECT_EQ(json["results"][2]["pareto"], false);
  EXPECT_THAT(SweepText(ExampleSweep()),
              HasSubstr("failed (it broke)  broken"));
  const std::string csv = SweepCsv(ExampleSweep());
  EXPECT_EQ(Count(csv, "\n"), 5u);
  EXPECT_THAT(
      csv, HasSubstr("name,options,usable,failure,pareto,error_mm,seconds\n"));
  EXPECT_THAT(csv, HasSubstr("1,,1,4,1\n"));
  EXPECT_THAT(csv, HasSubstr("0,\"it broke\",0,,\n"));
}

TEST(SweepReport, ChartMarksTheFrontAndGreysTheRest) {
  const std::string svg = SweepSvg(ExampleSweep());
  EXPECT_EQ(Count(svg, "<circle"), 3u);  // not what failed
  EXPECT_EQ(Count(svg, "fill=\"#0072b2\"><title>"), 2u);
  EXPECT_EQ(Count(svg, "fill=\"#aaaaaa\"><title>"), 1u);
  // The text shown on hovering has the settings, escaped.
  EXPECT_THAT(svg, HasSubstr("step.substeps = &quot;&lt;good&gt;&quot;"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
}

TEST(SweepReport, ChartHasTicksAndLabelsThatFit) {
  SweepReport report = ExampleSweep();
  report.results[0].setting.name = "a_name_that_is_rather_long";
  const std::string svg = SweepSvg(report);
  // The dearest stands at the right edge: its label ends there.
  EXPECT_THAT(svg,
              testing::ContainsRegex(
                  "text-anchor=\"end\">a_name_that_is_rather_long<"));
  EXPECT_THAT(svg, HasSubstr("text-anchor=\"start\">fast<"));
  // Errors from 1 to 5 only, yet more than three lines to read them by.
  for (const char* tick : {">2<", ">3<", ">4<"})
    EXPECT_THAT(svg, HasSubstr(tick));
}

TEST(SweepReport, SpreadAndWorkStandBesideTheMedian) {
  SweepReport report = ExampleSweep();
  auto& values = report.results[0].values;
  values.emplace_back("seconds_least", 7);
  values.emplace_back("seconds_largest", 9.5);
  values.emplace_back("sequence.factorizations", 110);
  values.emplace_back("sequence.solves", 1201);
  values.emplace_back("sequence.contact_queries", 40000);
  const std::string page = SweepHtml(report);
  EXPECT_THAT(page, HasSubstr("<td>8 (7 to 9.5)</td>"));
  EXPECT_THAT(page, Not(HasSubstr("seconds_least")));
  EXPECT_THAT(page, HasSubstr("<td>40000</td>"));
  EXPECT_THAT(SweepCsv(report), HasSubstr(",seconds_least,seconds_largest,"));
  const std::string text = SweepText(report);
  EXPECT_THAT(text, HasSubstr("queries  setting\n"));
  EXPECT_THAT(text, testing::ContainsRegex("110 +1201 +40000  good\n"));
}

TEST(SweepReport, PageSaysTheVerdict) {
  const std::string page = SweepHtml(ExampleSweep());
  EXPECT_THAT(page, HasSubstr("best error 1: good"));
  EXPECT_THAT(page, HasSubstr("failed: it broke"));
  EXPECT_THAT(page, HasSubstr("<svg"));
}

TEST(SweepReport, NothingUsableStillMakesAChart) {
  SweepReport report = ExampleSweep();
  report.results = {report.results[3]};
  EXPECT_THAT(SweepSvg(report), Not(HasSubstr("nan")));
  EXPECT_THAT(SweepText(report), HasSubstr("no setting succeeded"));
}

}  // namespace
}  // namespace invsim
