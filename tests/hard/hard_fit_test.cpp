// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/hard_fit.h"

#include <gtest/gtest.h>

#include <ostream>
#include <set>
#include <stdexcept>
#include <utility>

#include "invsim/report/fit_report.h"
#include "test_name.h"

namespace invsim {

void PrintTo(const HardFitCase& hard, std::ostream* out) { *out << hard.name; }

namespace {

class HardFitTest : public testing::TestWithParam<HardFitCase> {};

TEST_P(HardFitTest, Holds) {
  const HardFitOutcome outcome = RunHardFitCase(GetParam());
  const std::string& refusal = GetParam().refusal;
  EXPECT_EQ(outcome.refused, !refusal.empty()) << outcome.refusal;
  EXPECT_NE(outcome.refusal.find(refusal), std::string::npos)
      << outcome.refusal << "\n expected: " << refusal;
  for (const std::string& broken : outcome.broken)
    ADD_FAILURE() << GetParam().name << ": " << broken;
  if (outcome.refused) return;
  // What a user is told.
  FitReport report;
  report.result = outcome.result;
  const std::string text = FitText(report);
  EXPECT_NE(text.find(outcome.result.reason), std::string::npos);
  for (const auto& [why, count] : outcome.result.stats.step.failures)
    EXPECT_NE(text.find(why), std::string::npos) << why;
}

INSTANTIATE_TEST_SUITE_P(Gallery,
                         HardFitTest,
                         testing::ValuesIn(HardFitCases()),
                         TestName<HardFitCase>);

TEST(HardFitCases, NamesAreUnique) {
  std::set<std::string> names;
  for (const HardFitCase& hard : HardFitCases())
    EXPECT_TRUE(names.insert(hard.name).second) << hard.name;
}

HardFit Fit(const char* name) {
  for (const HardFitCase& hard : HardFitCases())
    if (hard.name == name) return hard.make();
  throw std::logic_error(name);
}

TEST(RunHardFit, SeesABodyThatIsElsewhere) {
  HardFit fit = Fit("data/two_frames");
  for (Vector3d& t : fit.truth->translations) t.x() += 0.05;
  const HardFitOutcome outcome = RunHardFit(std::move(fit));
  ASSERT_EQ(outcome.broken.size(), 1u);
  EXPECT_EQ(outcome.broken[0].rfind("body off by", 0), 0u);
}

TEST(RunHardFit, SeesAnotherEnd) {
  HardFit fit = Fit("optimiser/fails_for_good");
  fit.ends = {Termination::kConverged};
  fit.usable = true;
  EXPECT_EQ(RunHardFit(std::move(fit)).broken.size(), 2u);
}

}  // namespace
}  // namespace invsim
