// SPDX-License-Identifier: Apache-2.0
// How the map is drawn is in heat_map_test.cpp.
#include "invsim/report/hard_map_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

namespace invsim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

// Of three columns and two rows; the cell (i, j) took 10 j + i + 1 iterations
// per step.
HardMapReport ExampleMap() {
  HardMapReport report;
  report.map.name = "mu_dt";
  report.map.shows = "Friction & time";
  report.map.x_title = "friction";
  report.map.y_title = "step, s";
  report.map.x = {0.1, 1, 12300};
  report.map.y = {0.5, 0.25};
  report.map.y_labels = {"1/2", "1/4"};
  report.cells.assign(2, std::vector<HardMapCell>(3));
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 3; ++i) report.cells[j][i].iterations = 10 * j + i + 1;
  return report;
}

void BreakCell(HardMapCell* cell, const std::vector<std::string>& limits) {
  for (const std::string& limit : limits)
    cell->outcome.broken.push_back({limit, limit + " by too much"});
}

std::vector<std::string> MapLine(const std::string& text, int k) {
  std::istringstream in(text);
  std::string line, word;
  for (int i = 0; i <= k; ++i) std::getline(in, line);
  std::istringstream words(line);
  std::vector<std::string> all;
  while (words >> word) all.push_back(word);
  return all;
}

// As on the chart: the first row is the lowest.
TEST(HardMapReport, TheTableStandsAsTheChartDoes) {
  const std::string text = HardMapText(ExampleMap());
  EXPECT_THAT(text, HasSubstr("along: friction; down: step, s\n"));
  EXPECT_THAT(MapLine(text, 3), ElementsAre("0.1", "1", "12300"));
  EXPECT_THAT(MapLine(text, 4), ElementsAre("1/4", "11", "12", "13"));
  EXPECT_THAT(MapLine(text, 5), ElementsAre("1/2", "1", "2", "3"));
}

TEST(HardMapReport, LettersSayWhichLimitsBroke) {
  HardMapReport report = ExampleMap();
  BreakCell(&report.cells[0][1], {"energy", "penetration"});
  BreakCell(&report.cells[1][0], {"converged"});
  BreakCell(&report.cells[1][2], {"finite"});
  const std::string text = HardMapText(report);
  EXPECT_THAT(MapLine(text, 4), ElementsAre("1/4", "11", "M", "12", "13", "N"));
  EXPECT_THAT(MapLine(text, 5), ElementsAre("1/2", "1", "2", "PE", "3"));
}

TEST(HardMapReport, EveryLetterIsExplainedWithItsCells) {
  HardMapReport report = ExampleMap();
  for (HardMapCell& cell : report.cells[0]) BreakCell(&cell, {"penetration"});
  BreakCell(&report.cells[1][1], {"energy", "penetration"});
  const std::string svg = HardMapSvg(report);
  const std::string text = HardMapText(report);
  for (const char* note :
       {"N  not finite: the frame has no result (0 of 6 cells)",
        "M  missed: steps above the contact tolerance, counted (0 of 6 cells)",
        "P  penetration of more than 1 mm (4 of 6 cells)",
        "E  energy from nowhere: more than 1 % of what went about (1 of 6 "
        "cells)"}) {
    EXPECT_THAT(text, HasSubstr(std::string(note) + "\n"));
    EXPECT_THAT(svg, HasSubstr(std::string(note) + "</text>"));
  }
}

TEST(HardMapReport, TheChartHasTheNumbersLabelsAndLetters) {
  HardMapReport report = ExampleMap();
  BreakCell(&report.cells[1][2], {"converged", "energy"});
  const std::string svg = HardMapSvg(report);
  for (const char* text : {">Friction &amp; time<",
                           ">friction<",
                           ">step, s<",
                           ">iterations per step<",
                           ">0.1<",
                           ">12300<",
                           ">1/2<",
                           ">1/4<",
                           ">1<",
                           ">11<",
                           ">13<",
                           ">ME<"})
    EXPECT_THAT(svg, HasSubstr(text));
  EXPECT_THAT(svg, Not(HasSubstr(">0.25<")));
}

// Cells in rows, each with the values that it was made of.
TEST(HardMapReport, ProgramsGetEveryCellWithItsPlace) {
  HardMapReport report = ExampleMap();
  HardMapCell& cell = report.cells[1][0];
  cell.outcome.step.substeps = 30;
  cell.outcome.step.missed = 3;
  cell.outcome.step.halved = 2;
  cell.outcome.penetration = 0.0015;
  cell.outcome.energy = 0.125;
  BreakCell(&cell, {"penetration", "creep"});
  const nlohmann::json json = nlohmann::json::parse(HardMapJson(report));
  EXPECT_EQ(json["name"], "mu_dt");
  EXPECT_EQ(json["shows"], "Friction & time");
  EXPECT_EQ(json["x_title"], "friction");
  EXPECT_EQ(json["y_title"], "step, s");
  ASSERT_EQ(json["cells"].size(), 6u);
  for (int k = 0; k < 6; ++k) {
    const nlohmann::json& row = json["cells"][k];
    EXPECT_EQ(row["x"], report.map.x[k % 3]);
    EXPECT_EQ(row["y"], report.map.y[k / 3]);
    EXPECT_EQ(row["iterations_per_step"], 10 * (k / 3) + k % 3 + 1);
  }
  const nlohmann::json& row = json["cells"][3];
  EXPECT_EQ(row["substeps"], 30);
  EXPECT_EQ(row["substeps_missed"], 3);
  EXPECT_EQ(row["substeps_halved"], 2);
  EXPECT_DOUBLE_EQ(row["penetration_max_mm"], 1.5);
  EXPECT_EQ(row["energy_gain_relative"], 0.125);
  EXPECT_EQ(row["broken"],
            nlohmann::json({"penetration by too much", "creep by too much"}));
  EXPECT_EQ(json["cells"][4]["broken"], nlohmann::json::array());
}

// A scene that blew up has no energy to speak of.
TEST(HardMapReport, WhatIsNotFiniteIsNoNumber) {
  HardMapReport report = ExampleMap();
  report.cells[0][0].outcome.energy = INFINITY;
  const nlohmann::json json = nlohmann::json::parse(HardMapJson(report));
  EXPECT_TRUE(json["cells"][0]["energy_gain_relative"].is_null());
}

TEST(HardMapReport, AMapWithoutCellsIsNoError) {
  HardMapReport none;
  none.map.shows = "nothing";
  EXPECT_THAT(HardMapText(none), HasSubstr("(0 of 0 cells)"));
  EXPECT_TRUE(nlohmann::json::parse(HardMapJson(none))["cells"].empty());
}

}  // namespace
}  // namespace invsim
