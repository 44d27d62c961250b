// SPDX-License-Identifier: Apache-2.0
// The options of a step, and the sums of what steps did.
#include <gtest/gtest.h>

#include "invsim/base/config.h"
#include "invsim/base/error.h"
#include "invsim/base/options.h"
#include "invsim/sim/simulator.h"

namespace invsim {
namespace {

class StepOptionsTest : public ::testing::Test {
 protected:
  StepOptionsTest() { table_.AddSection("step", &options_); }
  void Read(const std::string& text) {
    table_.Read(Config::FromText(text, "f.toml"));
  }

  StepOptions options_;
  OptionTable table_;
};

TEST_F(StepOptionsTest, EveryKeySetsItsOwnMember) {
  Read(
      "step.substeps = 5\nstep.newton_iterations = 6\n"
      "step.newton_tolerance = 0.25\nstep.max_halvings = 7\n");
  EXPECT_EQ(options_.substeps, 5);
  EXPECT_EQ(options_.newton_iterations, 6);
  EXPECT_EQ(options_.newton_tolerance, 0.25);
  EXPECT_EQ(options_.max_halvings, 7);
  Read(
      "step.friction.tolerance = 0.5\nstep.friction.admm_iterations = 11\n"
      "step.friction.newton_iterations = 12\nstep.friction.retries = 3\n"
      "step.friction.krylov_tolerance = 0.125\n"
      "step.friction.krylov_iterations = 14\n");
  EXPECT_EQ(options_.friction.tolerance, 0.5);
  EXPECT_EQ(options_.friction.admm_iterations, 11);
  EXPECT_EQ(options_.friction.newton_iterations, 12);
  EXPECT_EQ(options_.friction.retries, 3);
  EXPECT_EQ(options_.friction.krylov_tolerance, 0.125);
  EXPECT_EQ(options_.friction.krylov_iterations, 14);
  EXPECT_EQ(table_.keys().size(), 10u);
}

// A step of none, a tolerance that nothing meets.
TEST_F(StepOptionsTest, WhatNoStepCanWorkWithIsRefused) {
  for (const char* bad : {"step.substeps = 0",
                          "step.newton_iterations = 0",
                          "step.newton_tolerance = 0.0",
                          "step.max_halvings = -1",
                          "step.max_halvings = 11",
                          "step.friction.tolerance = 0.0",
                          "step.friction.admm_iterations = -1",
                          "step.friction.newton_iterations = 0",
                          "step.friction.retries = 11",
                          "step.friction.krylov_tolerance = 0.0",
                          "step.friction.krylov_tolerance = 1.0",
                          "step.friction.krylov_iterations = -1"})
    EXPECT_THROW(Read(bad), UsageError) << bad;
  const StepOptions before;
  EXPECT_EQ(options_.substeps, before.substeps);
  EXPECT_EQ(options_.friction.tolerance, before.friction.tolerance);
}

TEST_F(StepOptionsTest, HalvingRetriesAndSplittingCanBeSwitchedOff) {
  Read(
      "step.max_halvings = 0\nstep.friction.retries = 0\n"
      "step.friction.admm_iterations = 0\n");
  EXPECT_EQ(options_.max_halvings, 0);
  EXPECT_EQ(options_.friction.retries, 0);
  EXPECT_EQ(options_.friction.admm_iterations, 0);
}

// Every figure another, so that none can stand for another.
StepStats StatsWithFigures() {
  StepStats s;
  s.substeps = 2;
  s.linearizations = 3;
  s.missed = 5;
  s.halved = 7;
  s.failed = 11;
  s.factorizations = 13;
  s.solves = 17;
  s.contact_queries = 3000000000;  // two of them are more than 32 bits hold
  s.admm_iterations = 23;
  s.newton_iterations = 29;
  s.open = 31;
  s.stick = 37;
  s.slide = 41;
  s.sweep_solves = 43;
  s.slip_solves = 7;
  s.yield_solves = 5;
  s.stopped = 47;
  s.assembly_seconds = 53;
  s.detection_seconds = 59;
  s.factor_seconds = 61;
  s.solve_seconds = 67;
  return s;
}

TEST(StepStats, WhatIsCountedAddsUp) {
  StepStats sum;
  for (int k = 0; k < 3; ++k) sum.Add(StatsWithFigures());
  EXPECT_EQ(sum.substeps, 6);
  EXPECT_EQ(sum.linearizations, 9);
  EXPECT_EQ(sum.missed, 15);
  EXPECT_EQ(sum.halved, 21);
  EXPECT_EQ(sum.failed, 33);
  EXPECT_EQ(sum.factorizations, 39);
  EXPECT_EQ(sum.solves, 51);
  EXPECT_EQ(sum.contact_queries, 9000000000);
  EXPECT_EQ(sum.admm_iterations, 69);
  EXPECT_EQ(sum.newton_iterations, 87);
  EXPECT_EQ(sum.open, 93);
  EXPECT_EQ(sum.stick, 111);
  EXPECT_EQ(sum.slide, 123);
  EXPECT_EQ(sum.sweep_solves, 129);
  EXPECT_EQ(sum.slip_solves, 21);
  EXPECT_EQ(sum.yield_solves, 15);
  EXPECT_EQ(sum.stopped, 141);
  EXPECT_EQ(sum.assembly_seconds, 159);
  EXPECT_EQ(sum.detection_seconds, 177);
  EXPECT_EQ(sum.factor_seconds, 183);
  EXPECT_EQ(sum.solve_seconds, 201);
}

// Whichever comes first.
TEST(StepStats, OfWhatIsMeasuredTheWorstIsKept) {
  StepStats mild, bad;
  mild.worst_residual = 1e-6;
  mild.most_contacts = 4;
  mild.most_cloth_contacts = 3;
  mild.most_crossings = 1;
  bad.worst_residual = 1e-3;
  bad.most_contacts = 40;
  bad.most_cloth_contacts = 30;
  bad.most_crossings = 10;
  for (const auto& [first, second] : {std::pair(mild, bad), {bad, mild}}) {
    StepStats sum = first;
    sum.Add(second);
    EXPECT_EQ(sum.worst_residual, 1e-3);
    EXPECT_EQ(sum.most_contacts, 40);
    EXPECT_EQ(sum.most_cloth_contacts, 30);
    EXPECT_EQ(sum.most_crossings, 10);
  }
}

TEST(StepStats, FailuresAddUpByTheirCause) {
  StepStats sum, next;
  sum.failures = {{"not finite", 2}, {"no factors", 1}};
  next.failures = {{"not finite", 3}, {"no memory", 4}};
  sum.Add(next);
  EXPECT_EQ(sum.failures,
            (std::map<std::string, int>{
                {"no factors", 1}, {"no memory", 4}, {"not finite", 5}}));
}

TEST(StepStats, AssemblyAddsUpByEffect) {
  StepStats sum, next;
  sum.effects.Add("membrane", 0.5);
  next.effects.Add("membrane", 0.25);
  next.effects.Add("bending", 2);
  sum.Add(next);
  EXPECT_EQ(sum.effects.seconds("membrane"), 0.75);
  EXPECT_EQ(sum.effects.seconds("bending"), 2);
}

// A sum that begins with nothing is the first of its parts.
TEST(StepStats, AddingToNothingIsACopy) {
  StepStats sum;
  sum.Add(StatsWithFigures());
  EXPECT_EQ(sum.substeps, 2);
  EXPECT_EQ(sum.worst_residual, 0);
  EXPECT_EQ(sum.contact_queries, 3000000000);
}

}  // namespace
}  // namespace invsim
