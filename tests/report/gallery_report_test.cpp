// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/gallery_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "report/fit_round.h"

namespace invsim {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

// Every figure another, so that none can stand for another.
GalleryRow SceneRow(const std::string& name) {
  GalleryRow row;
  row.hard.name = name;
  row.hard.shows = "what " + name + " shows";
  HardOutcome& o = row.outcome;
  o.frames = 31;
  o.step.substeps = 120;
  o.step.missed = 7;
  o.step.halved = 5;
  o.step.failed = 2;
  o.step.worst_residual = 3e-6;
  o.step.most_contacts = 44;
  o.step.admm_iterations = 901;
  o.step.newton_iterations = 302;
  o.step.factorizations = 203;
  o.penetration = 0.000125;
  o.overlap = 0.0025;
  o.energy = 2e-4;
  o.creep = 0.0005;
  o.speed = 1.5;
  o.misplaced = 6;
  o.closed = 9;
  o.derivative = 4e-8;
  o.columns = 7;
  o.switched = 1;
  o.seconds = 12.34;
  return row;
}

GalleryFitRow FitRow(const std::string& name) {
  GalleryFitRow row;
  row.hard.name = name;
  row.hard.shows = "what " + name + " shows";
  HardFitOutcome& o = row.outcome;
  o.result.termination = Termination::kStalled;
  o.result.simulated = true;
  o.result.reason = "The last steps failed.";
  OnlyRound(&o.result).optimizer.emplace();
  OptimizerSummary& s = *OnlyRound(&o.result).optimizer;
  s.initial_cost = 31;
  s.final_cost = 12.5;
  s.counts.evaluations = 23;
  s.counts.failed = 4;
  s.counts.no_derivative = 3;
  s.iterations.resize(2);
  o.result.stats.step.substeps = 500;
  o.result.stats.step.missed = 9;
  o.result.stats.step.failures = {{"not finite", 2}};
  o.start_error = 0.031;
  o.body_error = 0.0052;
  o.seconds = 5.67;
  return row;
}

GalleryRow Broken(GalleryRow row, const std::string& limit) {
  row.outcome.broken.push_back({limit, limit + " by too much"});
  return row;
}

nlohmann::json ParsedGallery(const GalleryReport& report) {
  return nlohmann::json::parse(GalleryJson(report));
}

// The words of the line that begins with `name`.
std::vector<std::string> GalleryLine(const GalleryReport& report,
                                     const std::string& name) {
  std::istringstream text(GalleryText(report));
  for (std::string line; std::getline(text, line);) {
    std::istringstream words(line);
    std::vector<std::string> all;
    for (std::string word; words >> word;) all.push_back(word);
    if (!all.empty() && all[0] == name) return all;
  }
  ADD_FAILURE() << "no line of " << name;
  return {};
}

TEST(GalleryReport, ALineHasTheFiguresOfItsScene) {
  const GalleryReport report = {true, {SceneRow("contact/corner")}, {}};
  // 113 of 120 steps converged; the penetration in mm.
  EXPECT_THAT(GalleryLine(report, "contact/corner"),
              testing::ElementsAre("contact/corner",
                                   "holds",
                                   "113/120",
                                   "3e-06",
                                   "0.125",
                                   "2e-04",
                                   "4e-08",
                                   "12.34"));
}

TEST(GalleryReport, ALineHasTheFiguresOfItsFit) {
  const GalleryReport report = {true, {}, {FitRow("data/holes")}};
  EXPECT_THAT(GalleryLine(report, "data/holes"),
              testing::ElementsAre("data/holes",
                                   "holds",
                                   "stalled",
                                   "31",
                                   ">",
                                   "12.5",
                                   "23",
                                   "4",
                                   "31",
                                   ">",
                                   "5.2",
                                   "5.67"));
  EXPECT_THAT(GalleryText(report),
              HasSubstr("data/holes: The last steps failed.\n"));
}

TEST(GalleryReport, ProgramsGetEveryFigureInTheUnitOfItsKey) {
  const nlohmann::json json =
      ParsedGallery({true, {SceneRow("contact/corner")}, {}});
  const nlohmann::json& scene = json["cases"][0];
  EXPECT_EQ(scene["name"], "contact/corner");
  EXPECT_EQ(scene["shows"], "what contact/corner shows");
  EXPECT_EQ(scene["result"], "holds");
  EXPECT_TRUE(scene["broken"].empty());
  EXPECT_EQ(scene["frames"], 31);
  EXPECT_EQ(scene["substeps"], 120);
  EXPECT_EQ(scene["substeps_missed"], 7);
  EXPECT_EQ(scene["substeps_halved"], 5);
  EXPECT_EQ(scene["substeps_failed"], 2);
  EXPECT_EQ(scene["worst_residual_weights"], 3e-6);
  EXPECT_EQ(scene["most_contacts"], 44);
  EXPECT_EQ(scene["splitting_iterations"], 901);
  EXPECT_EQ(scene["newton_iterations"], 302);
  EXPECT_EQ(scene["factorizations"], 203);
  EXPECT_DOUBLE_EQ(scene["penetration_max_mm"], 0.125);
  EXPECT_DOUBLE_EQ(scene["penetration_in_overlap_max_mm"], 2.5);
  EXPECT_EQ(scene["energy_gain_relative"], 2e-4);
  EXPECT_EQ(scene["speed_max_m_per_s"], 1.5);
  EXPECT_DOUBLE_EQ(scene["creep_max_mm"], 0.5);
  EXPECT_EQ(scene["vertices_misplaced"], 6);
  EXPECT_EQ(scene["faces_closed"], 9);
  EXPECT_EQ(scene["derivative_relative_error"], 4e-8);
  EXPECT_EQ(scene["derivative_columns"], 7);
  EXPECT_EQ(scene["derivative_columns_switched"], 1);
  EXPECT_EQ(scene["seconds"], 12.34);
}

TEST(GalleryReport, ProgramsGetEveryFigureOfAFit) {
  const nlohmann::json json = ParsedGallery({true, {}, {FitRow("data/holes")}});
  const nlohmann::json& fit = json["fits"][0];
  EXPECT_EQ(fit["result"], "holds");
  EXPECT_EQ(fit["status"], "stalled");
  EXPECT_EQ(fit["usable"], true);
  EXPECT_EQ(fit["initial_cost"], 31);
  EXPECT_EQ(fit["final_cost"], 12.5);
  EXPECT_EQ(fit["evaluations"], 23);
  EXPECT_EQ(fit["evaluations_failed"], 4);
  EXPECT_EQ(fit["evaluations_without_derivative"], 3);
  EXPECT_EQ(fit["steps_failed_because"]["not finite"], 2);
  EXPECT_EQ(fit["substeps"], 500);
  EXPECT_EQ(fit["substeps_missed"], 9);
  EXPECT_DOUBLE_EQ(fit["start_body_v2v_mean_mm"], 31);
  EXPECT_DOUBLE_EQ(fit["body_v2v_mean_mm"], 5.2);
  EXPECT_EQ(fit["seconds"], 5.67);
}

// Either alone, a scene or a fit, makes the gallery fail.
TEST(GalleryReport, NamesWhatFails) {
  GalleryReport report;
  report.rows = {SceneRow("contact/corner"),
                 Broken(SceneRow("time/long"), "penetration")};
  report.fits = {FitRow("data/holes")};
  EXPECT_FALSE(Holds(report));
  EXPECT_EQ(GalleryVerdict(report), "2 of 3 cases hold; failing: time/long.");
  EXPECT_EQ(GalleryLine(report, "time/long")[1], "FAILS");
  EXPECT_THAT(GalleryText(report),
              HasSubstr("time/long: penetration by too much\n"));

  report.fits[0].outcome.broken = {"uphill"};
  EXPECT_EQ(GalleryVerdict(report),
            "1 of 3 cases hold; failing: time/long, data/holes.");
  EXPECT_THAT(GalleryText(report), HasSubstr("data/holes: uphill\n"));
  report.rows.pop_back();
  EXPECT_FALSE(Holds(report));
  EXPECT_EQ(ParsedGallery(report)["holds"], false);
  EXPECT_EQ(ParsedGallery(report)["fits"][0]["broken"][0], "uphill");
}

// It is said, but fails nothing.
TEST(GalleryReport, AKnownBorderIsNoFailure) {
  GalleryReport report;
  report.rows = {Broken(SceneRow("time/long"), "energy")};
  report.rows[0].hard.border = "Steps of a second gain energy.";
  EXPECT_TRUE(Holds(report));
  EXPECT_EQ(GalleryVerdict(report),
            "0 of 1 cases hold, 1 are at a known border.");
  EXPECT_EQ(GalleryLine(report, "time/long")[1], "border");
  EXPECT_THAT(GalleryText(report),
              HasSubstr("time/long: energy by too much\n"
                        "time/long: known: Steps of a second gain energy.\n"));
  const nlohmann::json scene = ParsedGallery(report)["cases"][0];
  EXPECT_EQ(scene["result"], "border");
  EXPECT_EQ(scene["border"], "Steps of a second gain energy.");
  EXPECT_EQ(scene["broken"][0], "energy by too much");
}

// Beyond it other limits hold, or it fails.
TEST(GalleryReport, MoreThanIsKnownOfABorderFails) {
  GalleryReport report;
  report.rows = {Broken(SceneRow("time/long"), "energy")};
  report.rows[0].hard.border = "Steps of a second gain energy.";
  report.rows[0].outcome.beyond = {{"energy", "all of it twice"}};
  EXPECT_FALSE(Holds(report));
  EXPECT_EQ(GalleryLine(report, "time/long")[1], "FAILS");
  EXPECT_THAT(GalleryText(report),
              HasSubstr("time/long: beyond its border: all of it twice\n"));
}

// A border that is not met after all is no reason to say less of a case.
TEST(GalleryReport, ACaseThatHoldsInSpiteOfItsBorderHolds) {
  GalleryReport report;
  report.rows = {SceneRow("time/long")};
  report.rows[0].hard.border = "Steps of a second gain energy.";
  EXPECT_EQ(GalleryVerdict(report), "1 of 1 cases hold.");
  EXPECT_EQ(GalleryLine(report, "time/long")[1], "holds");
  EXPECT_THAT(GalleryText(report), Not(HasSubstr("known:")));
}

// A refusal has its reason instead of figures that nobody measured.
TEST(GalleryReport, WhatWasRefusedHasNoFigures) {
  GalleryReport report;
  report.rows = {SceneRow("geometry/fan")};
  report.rows[0].outcome.refused = true;
  report.rows[0].outcome.refusal = "an edge has three faces";
  report.fits = {FitRow("data/empty")};
  report.fits[0].outcome.refused = true;
  report.fits[0].outcome.refusal = "no points";
  const std::string text = GalleryText(report);
  EXPECT_THAT(text, ContainsRegex("geometry/fan +refused +an edge has three"));
  EXPECT_THAT(text, ContainsRegex("data/empty +refused +no points\n"));
  EXPECT_THAT(text, Not(HasSubstr("113/120")));
  EXPECT_THAT(text, Not(HasSubstr("The last steps failed.")));
  const nlohmann::json json = ParsedGallery(report);
  EXPECT_EQ(json["cases"][0]["refusal"], "an edge has three faces");
  EXPECT_FALSE(json["cases"][0].contains("substeps"));
  EXPECT_EQ(json["fits"][0]["refusal"], "no points");
  EXPECT_FALSE(json["fits"][0].contains("status"));
  // Of bad input that is as it is to be.
  EXPECT_EQ(GalleryVerdict(report), "2 of 2 cases hold.");
  report.rows[0] = Broken(report.rows[0], "refused");
  EXPECT_EQ(GalleryLine(report, "geometry/fan")[1], "FAILS");
}

TEST(GalleryReport, WhatIsNotKnownIsADash) {
  GalleryReport report;
  report.rows = {SceneRow("contact/corner")};
  report.rows[0].outcome.columns = 0;
  report.rows[0].outcome.derivative = NAN;
  report.fits = {FitRow("data/holes"), FitRow("data/none")};
  report.fits[0].outcome.start_error = NAN;
  report.fits[1].outcome.result.rounds[0].optimizer.reset();
  EXPECT_EQ(GalleryLine(report, "contact/corner")[6], "-");
  const std::string text = GalleryText(report);
  EXPECT_THAT(text, ContainsRegex("data/holes .* - > 5.2 "));
  EXPECT_THAT(text, ContainsRegex("data/none +holds +stalled +- +0 +0 +31 >"));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
  const nlohmann::json json = ParsedGallery(report);
  EXPECT_TRUE(json["cases"][0]["derivative_relative_error"].is_null());
  EXPECT_TRUE(json["fits"][0]["start_body_v2v_mean_mm"].is_null());
  EXPECT_FALSE(json["fits"][1].contains("final_cost"));
}

// The energy that cloth lost is no gain.
TEST(GalleryReport, ALossOfEnergyIsNoGain) {
  GalleryReport report;
  report.rows = {SceneRow("contact/corner")};
  report.rows[0].outcome.energy = -0.25;
  EXPECT_EQ(GalleryLine(report, "contact/corner")[5], "0e+00");
  EXPECT_EQ(ParsedGallery(report)["cases"][0]["energy_gain_relative"], -0.25);
}

TEST(GalleryReport, AnEmptyGalleryHolds) {
  const GalleryReport none;
  EXPECT_TRUE(Holds(none));
  EXPECT_EQ(GalleryText(none), "0 of 0 cases hold.\n");
  const nlohmann::json json = ParsedGallery(none);
  EXPECT_EQ(json["cases"], nlohmann::json::array());
  EXPECT_EQ(json["fits"], nlohmann::json::array());
}

TEST(GalleryReport, SaysWhetherTheDerivativeWasChecked) {
  for (const bool checked : {true, false})
    EXPECT_EQ(ParsedGallery({checked, {}, {}})["derivative_checked"], checked);
}

TEST(GalleryReport, ThePageHasEveryCaseEscaped) {
  GalleryReport report;
  report.rows = {Broken(SceneRow("time/long"), "energy")};
  report.rows[0].hard.shows = "dt > 1 & mu < 0";
  report.fits = {FitRow("data/holes")};
  const std::string page = GalleryHtml(report);
  EXPECT_THAT(
      page,
      HasSubstr("<td>time/long</td><td>FAILS: dt &gt; 1 &amp; mu &lt; 0</td>"));
  EXPECT_THAT(
      page,
      HasSubstr("<td>data/holes</td><td>holds: what data/holes shows</td>"));
  EXPECT_THAT(page, HasSubstr("<p>1 of 2 cases hold; failing: time/long.</p>"));
  EXPECT_THAT(page, HasSubstr("time/long: energy by too much\n"));
}

}  // namespace
}  // namespace invsim
