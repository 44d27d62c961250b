// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/run_summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "invsim/base/error.h"
#include "invsim/io/file.h"

namespace invsim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

namespace fs = std::filesystem;

class RunSummaryTest : public ::testing::Test {
 protected:
  RunSummaryTest() : root_(fs::path(::testing::TempDir()) / "run_summary") {
    fs::remove_all(root_);
    Write("fit/report.json",
          R"({"schema": "invsim.fit", "status": "converged",
              "verdict": "converged, body good",
              "inputs": {"frames": 60},
              "optimization": {"final_cost": 12.5},
              "simulation": {"solves": 1234}, "wall_seconds": 7})");
    Write("fit/config.resolved.toml",
          "[fit]\nload = \"balanced\"\n[lm]\niterations = 20\n");
    Write("fit/evaluation.json", R"({"metrics": {"joint_mean_mm": 2.25}})");
    Write("simulation/report.json",
          R"({"schema": "invsim.simulation", "status": "complete",
              "verdict": "complete", "counts": {"frames_done": 30},
              "total": {"solves": 99, "penetration_max_mm": 0.5}})");
    Write("simulation/config.resolved.toml",
          "[fit]\nload = \"balanced\"\n[step]\nsubsteps = 4\n");
  }
  ~RunSummaryTest() override { fs::remove_all(root_); }

  void Write(const std::string& name, const std::string& bytes) const {
    fs::create_directories((root_ / name).parent_path());
    WriteFileBytes((root_ / name).string(), bytes);
  }
  RunSummary Of(const std::string& name) const {
    return ReadRunSummary((root_ / name).string());
  }
  static std::optional<double> Figure(const RunSummary& run,
                                      const std::string& name) {
    for (size_t k = 0; k < FigureNames().size(); ++k)
      if (FigureNames()[k] == name) return run.figures[k];
    ADD_FAILURE() << name;
    return std::nullopt;
  }

  fs::path root_;
};

TEST_F(RunSummaryTest, FindsTheSameFigureInEveryKindOfRun) {
  const RunSummary fit = Of("fit"), simulation = Of("simulation");
  EXPECT_EQ(fit.status, "converged");
  EXPECT_EQ(fit.verdict, "converged, body good");
  EXPECT_EQ(Figure(fit, "frames"), 60);
  EXPECT_EQ(Figure(simulation, "frames"), 30);
  EXPECT_EQ(Figure(fit, "solves"), 1234);
  EXPECT_EQ(Figure(simulation, "solves"), 99);
  EXPECT_EQ(Figure(fit, "cost"), 12.5);
  EXPECT_EQ(Figure(simulation, "cost"), std::nullopt);
  EXPECT_EQ(Figure(fit, "penetration_max_mm"), std::nullopt);
  EXPECT_EQ(Figure(fit, "joint_mean_mm"), 2.25);
}

TEST_F(RunSummaryTest, NamesTheSettingsThatDiffer) {
  const std::vector<RunSummary> runs = {Of("fit"), Of("simulation")};
  EXPECT_THAT(DifferingSettings(runs),
              ElementsAre("lm.iterations", "step.substeps"));
  EXPECT_THAT(DifferingSettings({runs[0], runs[0]}), ElementsAre());
}

TEST_F(RunSummaryTest, TheTextHasAColumnForEachRun) {
  const std::string text = SummaryText({Of("fit"), Of("simulation")});
  EXPECT_THAT(text,
              HasSubstr((root_ / "fit").string() + ": converged, body good\n"));
  EXPECT_THAT(text, ::testing::ContainsRegex("solves +1234 +99\n"));
  EXPECT_THAT(text, ::testing::ContainsRegex("cost +12\\.5 +-\n"));
  EXPECT_THAT(text, ::testing::ContainsRegex("lm\\.iterations +20 +-\n"));
  // Nothing is said of what no run has, or all alike.
  EXPECT_THAT(text, Not(HasSubstr("evaluations")));
  EXPECT_THAT(text, Not(HasSubstr("fit.load")));
  // Folders of one name are told apart by their paths.
  EXPECT_THAT(text, ::testing::ContainsRegex("\n +fit +simulation\n"));
  EXPECT_THAT(SummaryText({Of("fit"), Of("simulation/../fit")}),
              ::testing::ContainsRegex("\n +/.*/fit +/.*/fit\n"));
}

TEST_F(RunSummaryTest, TheJsonHasWhatThereIs) {
  const auto json =
      nlohmann::json::parse(SummaryJson({Of("fit"), Of("simulation")}));
  EXPECT_EQ(json["schema"], "invsim.report");
  EXPECT_EQ(json["runs"][0]["figures"]["cost"], 12.5);
  EXPECT_FALSE(json["runs"][1]["figures"].contains("cost"));
  EXPECT_EQ(json["runs"][1]["settings"]["step.substeps"], "4");
  EXPECT_FALSE(json["runs"][0]["settings"].contains("fit.load"));
}

TEST_F(RunSummaryTest, RefusesWhatIsNoRun) {
  const auto refusal = [&](const std::string& name) -> std::string {
    try {
      Of(name);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(refusal("nowhere"), HasSubstr("nowhere: holds no report.json"));
  Write("gallery/report.json", R"({"schema": "invsim.gallery"})");
  EXPECT_THAT(refusal("gallery"), HasSubstr("found 'invsim.gallery'"));
  Write("fit/report.json",
        R"({"schema": "invsim.fit", "wall_seconds": "long"})");
  EXPECT_THAT(refusal("fit"),
              HasSubstr("wall_seconds: expected a number, found"));
}

}  // namespace
}  // namespace invsim
