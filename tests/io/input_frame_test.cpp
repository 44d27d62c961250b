// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/input_frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "invsim/base/error.h"

namespace invsim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// The corners of a box as large as a person: 0.6 wide, 1.7 high, 0.4 deep.
Points Person() {
  Points points(3, 2);
  points << -0.3, 0.3, 0, 1.7, -0.2, 0.2;
  return points;
}

TEST(InputFrameTest, TurnsZUpAndScales) {
  const InputFrame frame{LengthUnit::kMillimetre, UpAxis::kZ};
  Points input(3, 2);
  // Up, and the way the body faces.
  input << 0, 0, 0, -1000, 1000, 0;
  const Points inside = InsideFromInput(frame, input);
  EXPECT_TRUE(inside.col(0).isApprox(Vector3d(0, 1, 0)));
  EXPECT_TRUE(inside.col(1).isApprox(Vector3d(0, 0, 1)));
  EXPECT_TRUE(InputFromInside(frame, inside).isApprox(input));
  EXPECT_EQ(InsideFromInput({}, input), input);
}

TEST(InputFrameTest, NamesUnitsAndAxes) {
  EXPECT_STREQ(Name(LengthUnit::kMetre), "m");
  EXPECT_STREQ(Name(LengthUnit::kCentimetre), "cm");
  EXPECT_STREQ(Name(LengthUnit::kMillimetre), "mm");
  EXPECT_STREQ(Name(UpAxis::kY), "y");
  EXPECT_STREQ(Name(UpAxis::kZ), "z");
}

TEST(InputFrameTest, IsSetByOptions) {
  InputFrame frame;
  OptionTable table;
  table.AddSection("data", &frame);
  Config config;
  config.Assign("data.units=mm", "--set");
  config.Assign("data.up=z", "--set");
  table.Read(config);
  EXPECT_EQ(frame.unit, LengthUnit::kMillimetre);
  EXPECT_EQ(frame.up, UpAxis::kZ);
  config.Assign("data.units=inch", "--set");
  EXPECT_THROW(table.Read(config), UsageError);
}

TEST(InputFrameTest, GuessesEveryFrameOfAPerson) {
  for (LengthUnit unit :
       {LengthUnit::kMetre, LengthUnit::kCentimetre, LengthUnit::kMillimetre}) {
    for (UpAxis up : {UpAxis::kY, UpAxis::kZ}) {
      const InputFrame frame{unit, up};
      const InputFrameGuess guess =
          GuessInputFrame(InputFromInside(frame, Person()));
      EXPECT_EQ(guess.frame.unit, unit);
      EXPECT_EQ(guess.frame.up, up);
      EXPECT_NEAR(guess.height, 1.7, 1e-12);
      EXPECT_EQ(guess.warnings.size(),
                (unit != LengthUnit::kMetre) + (up == UpAxis::kZ));
    }
  }
  EXPECT_THAT(GuessInputFrame(Person()).warnings, IsEmpty());
  EXPECT_THAT(GuessInputFrame(100 * Person()).warnings,
              ElementsAre("the extent 170 looks like cm, not metres"));
}

TEST(InputFrameTest, WarnsOfWhatIsNoPersonUpright) {
  EXPECT_THAT(GuessInputFrame(1.6 * Person()).warnings,
              ElementsAre(HasSubstr("a height of 2.72 m is not a person's")));
  Points cube(3, 2);
  cube << 0, 1.7, 0, 1.7, 0, 1.7;
  EXPECT_THAT(GuessInputFrame(cube).warnings,
              ElementsAre(HasSubstr("either may be up")));
  EXPECT_THAT(
      GuessInputFrame(Points::Zero(3, 1)).warnings,
      ElementsAre(HasSubstr("either may be up"), HasSubstr("a height of 0 m")));
}

}  // namespace
}  // namespace invsim
