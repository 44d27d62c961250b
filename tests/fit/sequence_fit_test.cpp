// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/sequence_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <numbers>

#include "invsim/base/error.h"
#include "invsim/body/mannequin.h"
#include "invsim/sim/scene.h"
#include "sim/test_scene.h"

namespace invsim {
namespace {

using ::testing::ElementsAre;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

// A ball under a sheet, three times measured, that stands where it was made.
class SequenceFitTest : public ::testing::Test {
 protected:
  SequenceFitTest()
      : body_(BallBody()),
        garment_(SheetAboveBall(4, 0.2)),
        clouds_(3, garment_.placed) {
    for (size_t t = 0; t < clouds_.size(); ++t) start_.Append({});
  }

  FitResult Fit(bool optimize = false) const {
    SceneOptions options;
    options.step.substeps = 1;
    Simulator simulator(MakeSetup(options, body_, garment_, PlainCloth()));
    FitScene scene{body_,
                   garment_,
                   [&](const BodySequence& start) {
                     EXPECT_EQ(start.num_frames(), 3);
                     return &simulator;
                   },
                   clouds_,
                   30.0,
                   start_};
    if (dressed_)
      scene.reference = ClothReference{
          body_.Vertices({}),
          {garment_.placed, Points::Zero(3, garment_.num_vertices())}};
    scene.optimize = optimize;
    scene.checkpoint = checkpoint_;
    return FitSequence(scene, options_, observer_);
  }
  void ExpectRefused(const std::string& message) const {
    EXPECT_THAT([&] { Fit(); }, ThrowsMessage<InputError>(message));
  }

  BodyModel body_;
  Garment garment_;
  std::vector<Points> clouds_;
  BodySequence start_;
  bool dressed_ = true;
  std::string checkpoint_;
  FitOptions options_;
  FitObserver observer_;
};

TEST_F(SequenceFitTest, RefusesPointsThatCannotBeAPersonsByTheirFrame) {
  const std::vector<Points> good = clouds_;
  clouds_.clear();
  ExpectRefused("points: no frame");
  clouds_ = good;
  clouds_[1].resize(3, 0);
  ExpectRefused("points of frame 1: none");
  clouds_ = good;
  for (const double bad :
       {kNotANumber, std::numeric_limits<double>::infinity()}) {
    clouds_[2](1, 7) = bad;
    ExpectRefused("points of frame 2: not all finite");
  }
  // Wherever they are: far from the origin, too.
  clouds_ = good;
  clouds_[0] = 0.03 * clouds_[0];
  clouds_[0].colwise() += Vector3d(1, 2, 3);
  ExpectRefused("points of frame 0: all 25 within 6 mm; expected a person's");
  clouds_[0] = 0.06 * good[0];
  EXPECT_NO_THROW(Fit());
}

TEST_F(SequenceFitTest, RefusesAStartOfOtherFramesThanThePoints) {
  const std::string message = " frames, expected one per point cloud, 3";
  start_.Append({});
  ExpectRefused("the start has 4" + message);
  start_.poses.resize(2);
  start_.translations.resize(2);
  ExpectRefused("the start has 2" + message);
}

TEST_F(SequenceFitTest, RefusesAStartThatIsNotFiniteAnywhere) {
  const BodySequence good = start_;
  start_.shape[9] = kNotANumber;
  ExpectRefused("the start is not finite");
  start_ = good;
  start_.poses[2][71] = kNotANumber;
  ExpectRefused("the start is not finite");
  start_ = good;
  start_.translations[2][2] = -std::numeric_limits<double>::infinity();
  ExpectRefused("the start is not finite");
}

// What comes out is the start, as rotations that are no longer than half a
// turn, and the cloth on it.
TEST_F(SequenceFitTest, WithoutOptimisationTheStartIsDressed) {
  for (PoseVector& pose : start_.poses) pose[1] = 2 * std::numbers::pi + 0.1;
  std::vector<int> frames;
  observer_.frame = [&](const SimulatedFrame& f) { frames.push_back(f.frame); };
  const FitResult result = Fit();
  EXPECT_EQ(result.termination, Termination::kConverged);
  EXPECT_TRUE(result.usable());
  EXPECT_FALSE(result.optimizer());
  EXPECT_THAT(frames, ElementsAre(0, 1, 2));
  EXPECT_EQ(result.start.poses, start_.poses);
  EXPECT_NEAR(result.body.poses[2][1], 0.1, 1e-12);
  EXPECT_EQ(result.body.translations, start_.translations);
}

// Asked to stop after the start was evaluated, it still dresses what it has.
TEST_F(SequenceFitTest, WhatIsStoppedEarlyIsUsable) {
  int iterations = 0;
  observer_.iteration = [&](const FitIteration& i) {
    EXPECT_GT(i.steps, 0);
    ++iterations;
    return false;
  };
  const FitResult result = Fit(true);
  EXPECT_EQ(iterations, 1);
  EXPECT_EQ(result.termination, Termination::kInterrupted);
  EXPECT_TRUE(result.usable());
  EXPECT_EQ(result.body.translations, start_.translations);
}

// Each time from the body found before; what ended at least is the result.
TEST_F(SequenceFitTest, DressesAgainOnTheBodyFound) {
  dressed_ = false;
  for (Vector3d& t : start_.translations) t.x() = 0.02;
  std::vector<BodySequence> starts;
  BodySequence last;
  long steps = 0;
  observer_.iteration = [&](const FitIteration& i) {
    EXPECT_GE(i.steps, steps);
    steps = i.steps;
    if (i.record.iteration == 0) {
      if (!starts.empty()) {
        EXPECT_EQ(i.body.translations, last.translations);
      }
      starts.push_back(i.body);
    }
    last = i.body;
    return true;
  };
  const FitResult result = Fit(true);
  ASSERT_EQ(result.rounds.size(), 2u);
  ASSERT_EQ(starts.size(), 2u);
  EXPECT_EQ(starts[0].translations, start_.translations);
  EXPECT_NE(starts[1].translations, start_.translations);
  double least = result.rounds[0].optimizer->final_cost;
  for (const FitRound& round : result.rounds) {
    EXPECT_FALSE(round.dressing.tries.empty());
    least = std::min(least, round.optimizer->final_cost);
  }
  EXPECT_EQ(result.optimizer()->final_cost, least);
  EXPECT_EQ(result.iterations(),
            result.rounds[0].optimizer->num_iterations() +
                result.rounds[1].optimizer->num_iterations());
  EXPECT_GT(result.counts().evaluations,
            result.rounds[0].optimizer->counts.evaluations);
  // The cloth is simulated from where that round's began.
  EXPECT_NEAR(result.costs.cloth_to_points + result.costs.skin_to_points +
                  result.costs.points_to_surface,
              result.optimizer()->iterations.back().terms.data,
              1e-6 * least);
}

TEST_F(SequenceFitTest, DressesOnceIfAskedOrNotNeeded) {
  for (Vector3d& t : start_.translations) t.x() = 0.02;
  EXPECT_EQ(Fit(true).rounds.size(), 1u);  // dressed already
  dressed_ = false;
  options_.dressings = 1;
  EXPECT_EQ(Fit(true).rounds.size(), 1u);
  // Who has not come to an end is told so, not begun anew.
  options_.dressings = 2;
  observer_.iteration = [](const FitIteration& i) {
    return i.record.iteration < 1;
  };
  const FitResult stopped = Fit(true);
  EXPECT_EQ(stopped.rounds.size(), 1u);
  EXPECT_EQ(stopped.termination, Termination::kInterrupted);
}

// More iterations lead to another body, on which all after it is done anew:
// the result is that of a fit that had them from the start.
TEST_F(SequenceFitTest, MoreIterationsAreAsIfThereHadBeenMoreAtOnce) {
  dressed_ = false;
  for (Vector3d& t : start_.translations) t.x() = 0.02;
  const auto fit = [&](int iterations, const std::string& folder) {
    OptionTable table;
    Describe(&table, &options_);
    Config config;
    config.Set("lm.iterations", std::to_string(iterations), "here");
    table.Read(config);
    checkpoint_ = folder;
    return Fit(true);
  };
  const std::filesystem::path root =
      std::filesystem::path(::testing::TempDir()) / "invsim_more_iterations";
  std::filesystem::remove_all(root);
  for (const char* name : {"a", "b"})
    std::filesystem::create_directories(root / name);
  const FitResult little = fit(1, root / "a");
  ASSERT_EQ(little.rounds.size(), 2u);
  const FitResult more = fit(4, root / "a");
  const FitResult at_once = fit(4, root / "b");
  EXPECT_GT(more.recalled, 0);
  EXPECT_NE(more.body.translations, little.body.translations);
  EXPECT_EQ(more.kept, at_once.kept);
  EXPECT_EQ(more.body.translations, at_once.body.translations);
  EXPECT_EQ(more.body.poses, at_once.body.poses);
  EXPECT_EQ(more.optimizer()->final_cost, at_once.optimizer()->final_cost);
  std::filesystem::remove_all(root);
}

// Plays back costs, one list for each run, with the body where it began.
struct Script {
  std::vector<std::vector<double>> runs;
  bool first_step_gains_most = true;
  size_t begun = 0, seen = 0;
};

class ScriptedOptimizer : public Optimizer {
 public:
  explicit ScriptedOptimizer(Script* script) : script_(script) {}
  bool first_step_gains_most() const override {
    return script_->first_step_gains_most;
  }
  OptimizerSummary Run(Objective*,
                       const IterationObserver& observer) const override {
    OptimizerSummary summary;
    summary.termination = Termination::kConverged;
    summary.reason = "The end of the script.";
    script_->seen = 0;
    for (const double cost : script_->runs.at(script_->begun++)) {
      IterationRecord record;
      record.iteration = static_cast<int>(script_->seen++);
      record.cost = summary.final_cost = cost;
      if (observer(record)) continue;
      summary.termination = Termination::kInterrupted;
      break;
    }
    return summary;
  }

 private:
  Script* script_;
};

class ScriptedChoice : public Choice<Optimizer> {
 public:
  explicit ScriptedChoice(Script* script) : script_(script) {}
  void AddOptions(OptionTable*) override {}
  std::unique_ptr<Optimizer> Make() const override {
    return std::make_unique<ScriptedOptimizer>(script_);
  }

 private:
  Script* script_;
};

// By what its first step that helped leaves: twice its gain does not lead from
// 20 over 15 below 6, but from 20 over 12 it does.
TEST_F(SequenceFitTest, GivesUpADressingWhoseFirstStepStaysFarAbove) {
  dressed_ = false;
  options_.optimizer = "script";
  const auto fit = [&](Script* script) {
    options_.optimizers["script"] = std::make_unique<ScriptedChoice>(script);
    return Fit(true);
  };
  Script hopeless{{{30, 6}, {20, 20, 15, 5}}};
  const FitResult result = fit(&hopeless);
  ASSERT_EQ(result.rounds.size(), 2u);
  EXPECT_EQ(hopeless.seen, 3u);
  EXPECT_EQ(result.kept, 0);
  EXPECT_EQ(result.termination, Termination::kConverged);
  EXPECT_EQ(result.rounds[1].optimizer->termination, Termination::kGivenUp);
  EXPECT_EQ(result.rounds[1].optimizer->reason,
            "Its first step did not come near the cost of what is kept, 6.");

  Script hopeful{{{30, 6}, {20, 12, 5}}};
  EXPECT_EQ(fit(&hopeful).kept, 1);
  Script slow{{{30, 6}, {20, 19, 5}}, false};
  EXPECT_EQ(fit(&slow).kept, 1);
  Script alone{{{30, 29, 7}, {20}}};  // never the first
  EXPECT_EQ(fit(&alone).rounds[0].optimizer->final_cost, 7);
}

// Finds the time over after its first evaluation; makes nothing of those it
// cannot have.
class LateOptimizer : public Optimizer {
 public:
  explicit LateOptimizer(double* limit) : limit_(limit) {}
  OptimizerSummary Run(Objective* objective,
                       const IterationObserver& observer) const override {
    OptimizerSummary summary;
    summary.termination = Termination::kStalled;
    IterationRecord& record = summary.iterations.emplace_back();
    EXPECT_TRUE(objective->Evaluate(&record.cost, nullptr));
    summary.initial_cost = summary.final_cost = record.cost;
    EXPECT_TRUE(observer(record));
    *limit_ = 1e-9;
    objective->x()->translations[0].x() += 0.001;
    double cost;
    EXPECT_FALSE(objective->Evaluate(&cost, nullptr));
    objective->x()->translations[0].x() -= 0.001;
    return summary;
  }

 private:
  double* limit_;
};

class LateChoice : public Choice<Optimizer> {
 public:
  explicit LateChoice(double* limit) : limit_(limit) {}
  void AddOptions(OptionTable*) override {}
  std::unique_ptr<Optimizer> Make() const override {
    return std::make_unique<LateOptimizer>(limit_);
  }

 private:
  double* limit_;
};

TEST_F(SequenceFitTest, ATimeLimitEndsAnEvaluation) {
  options_.optimizer = "late";
  options_.time_limit = 3600;
  options_.optimizers["late"] =
      std::make_unique<LateChoice>(&options_.time_limit);
  const FitResult result = Fit(true);
  EXPECT_EQ(result.termination, Termination::kTimeLimit) << result.reason;
  EXPECT_TRUE(result.usable());
  EXPECT_EQ(result.optimizer()->termination, Termination::kInterrupted);
  EXPECT_FALSE(result.uncertainty);
}

// What is left of it is dressed, and simulated, once.
TEST_F(SequenceFitTest, ATimeLimitThatIsOverAtOnceLeavesACloth) {
  dressed_ = false;
  start_.shape[0] = 1;
  options_.time_limit = 1e-9;
  const FitResult result = Fit(true);
  EXPECT_EQ(result.termination, Termination::kTimeLimit) << result.reason;
  EXPECT_TRUE(result.usable());
  ASSERT_EQ(result.rounds.size(), 1u);
  EXPECT_EQ(result.rounds[0].dressing.tries.size(), 1u);
  EXPECT_TRUE(result.rounds[0].dressing.cut_short);
}

TEST_F(SequenceFitTest, GoesOnFromTheSameInputsOnly) {
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / "invsim_same_inputs";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  checkpoint_ = folder.string();
  Fit();
  EXPECT_NO_THROW(Fit());
  const auto expect_named = [&](const std::string& what) {
    ExpectRefused(checkpoint_ + "/inputs.txt: " + what +
                  " changed since the fit was begun; choose another folder, "
                  "or --force to begin anew");
  };
  const std::vector<Points> clouds = clouds_;
  clouds_[1].array() += 0.05;
  expect_named("the points of frame 1");
  clouds_ = clouds;
  start_.translations[0].x() += 1e-9;
  expect_named("the start");
  start_.translations[0].x() = 0;
  garment_.rest(0, 3) += 1e-6;
  expect_named("the garment");
  garment_ = SheetAboveBall(4, 0.2);
  BodyModelData data = body_.data();
  data.shapedirs(5, 0) += 1e-6;
  const BodyModel body = body_;
  body_ = BodyModel(data);
  expect_named("the body");
  body_ = body;
  EXPECT_NO_THROW(Fit());
  std::filesystem::remove_all(folder);
}

// The time is over while the garment is put on again.
TEST_F(SequenceFitTest, ATimeLimitInTheNextDressingIsReported) {
  dressed_ = false;
  for (Vector3d& t : start_.translations) t.x() = 0.02;
  options_.time_limit = 3600;
  bool converged = false;
  observer_.iteration = [&](const FitIteration&) { return converged = true; };
  observer_.relaxation = [&](const RelaxationFrame&) {
    if (converged) options_.time_limit = 1e-9;
  };
  const FitResult result = Fit(true);
  ASSERT_EQ(result.rounds.size(), 2u);
  EXPECT_FALSE(result.rounds[1].optimizer);
  EXPECT_EQ(result.kept, 0);
  EXPECT_EQ(result.termination, Termination::kTimeLimit) << result.reason;
  EXPECT_TRUE(result.usable());
}

// The points alone would keep the left forearm where it was measured, deep in
// the trunk.
TEST_F(SequenceFitTest, PartsOfTheBodyAreMovedOutOfEachOther) {
  body_ = Mannequin();
  for (PoseVector& pose : start_.poses) {
    pose[3 * 16 + 2] = -1.2;  // the shoulder
    pose[3 * 18 + 2] = -1.6;  // the elbow
  }
  garment_.placed.row(1).array() += 2;  // over its head
  clouds_.assign(3, body_.Vertices(start_.Frame(0)));
  observer_.iteration = [](const FitIteration& i) {
    return i.record.iteration < 3;
  };
  const auto overlap = [&](double weight) {
    options_.priors.overlap = weight;
    return Fit(true).optimizer()->iterations.back().terms.overlap / weight;
  };
  EXPECT_EQ(Fit(true).optimizer()->iterations.back().terms.overlap, 0);
  const double light = overlap(1e-3);
  EXPECT_GT(light, 0);
  EXPECT_LT(overlap(100), 0.5 * light);
}

// So far away that no number is left of the cloth.
TEST_F(SequenceFitTest, SaysWhyTheGarmentCannotBeSimulated) {
  for (Vector3d& t : start_.translations) t.setConstant(1e200);
  const FitResult result = Fit();
  EXPECT_EQ(result.termination, Termination::kFailed);
  EXPECT_FALSE(result.usable());
  EXPECT_THAT(
      result.reason,
      StartsWith("The garment cannot be simulated on the body found: "));
}

}  // namespace
}  // namespace invsim
