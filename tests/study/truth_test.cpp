// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/truth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "cloth/test_cloth.h"
#include "invsim/base/error.h"
#include "invsim/io/npz.h"

namespace invsim {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr int kTruthFrames = 3, kTruthVertices = 5;

class TruthTest : public ::testing::Test {
 protected:
  TruthTest() : path_(::testing::TempDir() + "truth_test.npz") {
    truth_.body.frame_rate = 50;
    truth_.body.shape[3] = 0.7;
    for (int t = 0; t < kTruthFrames; ++t) {
      truth_.body.poses.push_back(PoseVector::Constant(0.1 * t));
      truth_.body.translations.push_back(Vector3d(t, 0, -t));
      truth_.cloth.push_back(RandomPoints(kTruthVertices, 2.0, t));
      truth_.cloth_velocities.push_back(
          RandomPoints(kTruthVertices, 9.0, 10 + t));
    }
  }
  // Writes the truth with one array replaced.
  void WriteWith(const std::string& name, const NpyArray& array) const {
    NpzArrays arrays = MotionArrays(truth_.body);
    arrays.push_back({name, array});
    WriteNpz(path_, arrays);
  }
  void ExpectRefused(const std::string& what) const {
    EXPECT_THAT(
        [&] { ReadTruth(path_); },
        ThrowsMessage<InputError>(AllOf(HasSubstr(path_), HasSubstr(what))));
  }

  std::string path_;
  Truth truth_;
};

// The cloth in 32 bits, which is a tenth of a micrometre, the body in all.
TEST_F(TruthTest, IsReadBackAsItWasWritten) {
  WriteTruth(path_, truth_);
  const Truth read = ReadTruth(path_);
  EXPECT_EQ(read.body.frame_rate, 50);
  EXPECT_EQ(read.body.shape, truth_.body.shape);
  EXPECT_EQ(read.body.poses, truth_.body.poses);
  EXPECT_EQ(read.body.translations, truth_.body.translations);
  ASSERT_EQ(read.cloth.size(), truth_.cloth.size());
  ASSERT_EQ(read.cloth_velocities.size(), truth_.cloth_velocities.size());
  for (int t = 0; t < kTruthFrames; ++t) {
    EXPECT_EQ(read.cloth[t],
              Points(truth_.cloth[t].cast<float>().cast<double>()));
    EXPECT_EQ(read.cloth_velocities[t],
              Points(truth_.cloth_velocities[t].cast<float>().cast<double>()));
  }
}

// For whoever opens it in Python: (frame, vertex, coordinate).
TEST_F(TruthTest, ArraysAreIndexedByFrameVertexCoordinate) {
  WriteTruth(path_, truth_);
  const NpyArray cloth = ReadNpz(path_).Array("cloth");
  EXPECT_EQ(cloth.Description(), "f4 (3, 5, 3)");
  EXPECT_THAT(ReadNpz(path_).Array("cloth_velocities").shape(),
              ElementsAre(kTruthFrames, kTruthVertices, 3));
  const std::vector<double> values = cloth.ToDoubles(path_);
  EXPECT_NEAR(
      values[(2 * kTruthVertices + 4) * 3 + 1], truth_.cloth[2](1, 4), 1e-6);
  EXPECT_NEAR(
      values[(1 * kTruthVertices + 0) * 3 + 2], truth_.cloth[1](2, 0), 1e-6);
}

// A recorded motion is a truth of which no cloth is known, and any truth is a
// motion.
TEST_F(TruthTest, WhatIsNotKnownIsLeftOut) {
  truth_.cloth_velocities.clear();
  WriteTruth(path_, truth_);
  EXPECT_EQ(ReadTruth(path_).cloth.size(), truth_.cloth.size());
  EXPECT_TRUE(ReadTruth(path_).cloth_velocities.empty());
  EXPECT_FALSE(ReadNpz(path_).Has("cloth_velocities"));
  EXPECT_EQ(ReadMotion(path_).poses, truth_.body.poses);

  WriteMotion(path_, truth_.body);
  EXPECT_TRUE(ReadTruth(path_).cloth.empty());
  EXPECT_EQ(ReadTruth(path_).body.poses, truth_.body.poses);
}

TEST_F(TruthTest, ClothThatDoesNotFitTheMotionIsRefused) {
  // One frame too few.
  WriteWith("cloth", NpyArray::Floats({2, 5, 3}, std::vector<double>(30)));
  ExpectRefused("cloth is f4 (2, 5, 3): expected shape (3, N, 3)");
  // Coordinates first.
  WriteWith("cloth_velocities",
            NpyArray::Floats({3, 3, 5}, std::vector<double>(45)));
  ExpectRefused("cloth_velocities is f4 (3, 3, 5)");
}

TEST_F(TruthTest, NumbersThatAreNotFiniteAreRefused) {
  for (const double bad : {std::nan(""), HUGE_VAL}) {
    std::vector<double> values(45);
    values[44] = bad;
    for (const char* name : {"cloth", "cloth_velocities"}) {
      WriteWith(name, NpyArray::Floats({3, 5, 3}, values));
      ExpectRefused(std::string(name) + " holds a number that is not finite");
    }
  }
}

}  // namespace
}  // namespace invsim
