// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/fit_checkpoint.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <string>

#include "invsim/base/error.h"
#include "invsim/base/random.h"
#include "invsim/io/file.h"

namespace invsim {
namespace {

Points RandomPoints(int n, Random* random) {
  Points points(3, n);
  for (double& value : points.reshaped()) value = random->Normal();
  return points;
}

TEST(FitCheckpoint, GivesBackEveryBit) {
  Random random(1);
  BodySequence start;
  for (double& b : start.shape) b = random.Normal();
  for (int t = 0; t < 4; ++t) {
    BodyParameters p;
    for (double& angle : p.pose) angle = random.Normal();
    p.translation = RandomPoints(1, &random);
    start.Append(p);
  }
  const ClothReference reference{
      RandomPoints(7, &random),
      {RandomPoints(5, &random), RandomPoints(5, &random)}};
  const FitCheckpoint checkpoint(::testing::TempDir());
  checkpoint.Save(start);
  checkpoint.Save(2, reference);
  const auto start2 = checkpoint.LoadStart(4);
  const auto reference2 = checkpoint.LoadReference(2, reference.body, 5);
  ASSERT_TRUE(start2 && reference2);
  EXPECT_EQ(start2->shape, start.shape);
  EXPECT_EQ(start2->poses, start.poses);
  EXPECT_EQ(start2->translations, start.translations);
  EXPECT_EQ(reference2->body, reference.body);
  EXPECT_EQ(reference2->cloth.x, reference.cloth.x);
  EXPECT_EQ(reference2->cloth.v, reference.cloth.v);
  EXPECT_FALSE(checkpoint.LoadReference(3, reference.body, 5));
  EXPECT_NE(checkpoint.Evaluations(2), checkpoint.Evaluations(3));
  EXPECT_THROW(checkpoint.LoadStart(5), InputError);
  EXPECT_THROW(checkpoint.LoadReference(2, reference.body, 6), InputError);
}

// After more iterations than the first time the body found is another, and so
// is all that came of it.
TEST(FitCheckpoint, ForgetsWhatWasDressedOnAnotherBody) {
  Random random(3);
  const FitCheckpoint checkpoint(::testing::TempDir());
  ClothReference reference{
      RandomPoints(7, &random),
      {RandomPoints(5, &random), RandomPoints(5, &random)}};
  checkpoint.Save(1, reference);
  WriteFileBytes(checkpoint.Evaluations(1), "of it");
  ASSERT_TRUE(checkpoint.LoadReference(1, reference.body, 5));
  reference.body(0, 3) += 1e-15;
  EXPECT_FALSE(checkpoint.LoadReference(1, reference.body, 5));
  checkpoint.Save(1, reference);
  EXPECT_TRUE(checkpoint.LoadReference(1, reference.body, 5));
  EXPECT_FALSE(std::filesystem::exists(checkpoint.Evaluations(1)));
}

TEST(FitCheckpoint, RefusesClothThatIsNotFinite) {
  const FitCheckpoint checkpoint(::testing::TempDir());
  ClothReference reference{Points::Ones(3, 4),
                           {Points::Zero(3, 5), Points::Zero(3, 5)}};
  reference.cloth.v(1, 2) = std::numeric_limits<double>::infinity();
  checkpoint.Save(1, reference);
  try {
    checkpoint.LoadReference(1, reference.body, 5);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(
        std::string(error.what()).find("reference_1.npz: v: expected finite"),
        std::string::npos)
        << error.what();
  }
}

// Somebody else's file may have anything in it; what is said is one line.
TEST(FitCheckpoint, NamesWhatChangedInOneLine) {
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / "invsim_fit_line";
  std::filesystem::create_directories(folder);
  WriteFileBytes((folder / "inputs.txt").string(), "0a a\x1b[31m\rname\n");
  try {
    FitCheckpoint(folder.string()).Open({});
    FAIL();
  } catch (const InputError& error) {
    for (const char c : std::string(error.what())) EXPECT_GE(c, ' ');
  }
  std::filesystem::remove_all(folder);
}

TEST(FitCheckpoint, GoesOnFromTheSameInputsOnly) {
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / "invsim_fit_inputs";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const FitCheckpoint checkpoint(folder.string());
  const auto refusal = [&](const InputDigests& inputs) -> std::string {
    try {
      checkpoint.Open(inputs);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const InputDigests inputs = {{"the body", "0a"}, {"the points", "1b"}};
  EXPECT_EQ(refusal(inputs), "");
  EXPECT_EQ(refusal(inputs), "");
  const std::string file = (folder / "inputs.txt").string(),
                    rest =
                        " changed since the fit was begun; choose another "
                        "folder, or --force to begin anew";
  EXPECT_EQ(refusal({{"the body", "0a"}, {"the points", "2b"}}),
            file + ": the points" + rest);
  EXPECT_EQ(refusal({{"the body", "0a"}}), file + ": the points" + rest);
  EXPECT_EQ(
      refusal({{"a start", "3"}, {"the body", "0"}, {"the points", "1b"}}),
      file + ": a start and 1 more" + rest);
  EXPECT_EQ(refusal(inputs), "");
  // What was begun by something that kept no digests.
  checkpoint.Save(BodySequence{{}, {PoseVector::Zero()}, {Vector3d::Zero()}});
  std::filesystem::remove(file);
  EXPECT_NE(refusal(inputs).find("inputs.txt: is missing"), std::string::npos);
  std::filesystem::remove_all(folder);
}

TEST(FitCheckpoint, FindsNothingWhereNothingIsKept) {
  const FitCheckpoint none("");
  none.Save(BodySequence{});
  EXPECT_FALSE(none.LoadStart(0));
  EXPECT_FALSE(none.LoadReference(1, Points::Zero(3, 1), 1));
}

}  // namespace
}  // namespace invsim
