// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "invsim/base/error.h"
#include "invsim/body/motion.h"
#include "invsim/io/npz.h"
#include "test_bodies.h"

namespace invsim {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class MotionIo : public ::testing::Test {
 protected:
  MotionIo() : path_(::testing::TempDir() + "/motion_io_test.npz") {}
  ~MotionIo() override { std::filesystem::remove(path_); }

  // Two frames of `numbers` pose numbers 0, 1, 2, ...
  static NpzArrays Arrays(int numbers) {
    std::vector<double> poses(2 * numbers);
    for (std::size_t k = 0; k < poses.size(); ++k) poses[k] = 0.001 * k;
    return {{"poses", NpyArray::Floats({2, numbers}, poses)},
            {"trans", NpyArray::Doubles({2, 3}, {1, 2, 3, 4, 5, 6})},
            {"mocap_framerate", NpyArray::Doubles({}, {120})}};
  }
  void Write(NpzArrays arrays, const NpzArrays& changes) {
    for (const auto& change : changes) {
      std::erase_if(arrays,
                    [&](const auto& a) { return a.first == change.first; });
      arrays.push_back(change);
    }
    WriteNpz(path_, arrays);
  }
  void ExpectError(const NpzArrays& changes, const std::string& message) {
    Write(Arrays(72), changes);
    EXPECT_THAT(
        [&] { ReadMotion(path_); },
        ThrowsMessage<InputError>(AllOf(HasSubstr(path_), HasSubstr(message))));
  }

  std::string path_;
};

TEST_F(MotionIo, WrittenMotionReadsBackExactly) {
  std::mt19937 rng(1);
  Motion motion;
  motion.frame_rate = 59.94;
  motion.gender = "female";
  motion.shape = RandomMatrix(kNumShape, 1, 1.0, &rng);
  for (int t = 0; t < 3; ++t) {
    motion.poses.push_back(RandomMatrix(kNumPose, 1, 1.0, &rng));
    motion.translations.push_back(RandomMatrix(3, 1, 1.0, &rng));
  }
  WriteMotion(path_, motion);
  const Motion read = ReadMotion(path_);
  EXPECT_EQ(read.frame_rate, motion.frame_rate);
  EXPECT_EQ(read.gender, motion.gender);
  EXPECT_EQ(read.shape, motion.shape);
  EXPECT_EQ(read.poses, motion.poses);
  EXPECT_EQ(read.translations, motion.translations);
  EXPECT_TRUE(ReadNpz(path_).Has("mocap_framerate"));
  EXPECT_TRUE(ReadNpz(path_).Has("mocap_frame_rate"));
}

TEST_F(MotionIo, MissingShapeAndGenderAreNeutral) {
  Write(Arrays(72), {});
  const Motion motion = ReadMotion(path_);
  EXPECT_EQ(motion.frame_rate, 120.0);
  EXPECT_EQ(motion.gender, "neutral");
  EXPECT_EQ(motion.shape.norm(), 0.0);
  EXPECT_NEAR(motion.poses[1][71], 0.143, 1e-8);
  EXPECT_EQ(motion.translations[1], Vector3d(4, 5, 6));
}

TEST_F(MotionIo, BodyOfSmplHAndSmplXIsTaken) {
  for (const int numbers : {156, 165}) {
    Write(Arrays(numbers), {});
    const Motion motion = ReadMotion(path_);
    EXPECT_NEAR(motion.poses[1][65], 0.001 * (numbers + 65), 1e-7);
    EXPECT_EQ(motion.poses[1].tail<6>().norm(), 0.0);
  }
}

TEST_F(MotionIo, FirstTenOfSixteenBetasAreTaken) {
  std::vector<double> betas(16);
  for (int k = 0; k < 16; ++k) betas[k] = k;
  Write(Arrays(72), {{"betas", NpyArray::Doubles({16}, betas)}});
  EXPECT_EQ(ReadMotion(path_).shape[9], 9.0);
  Write(Arrays(72), {{"betas", NpyArray::Doubles({2}, {1, 2})}});
  EXPECT_EQ(ReadMotion(path_).shape[1], 2.0);
  EXPECT_EQ(ReadMotion(path_).shape[2], 0.0);
}

TEST_F(MotionIo, EitherNameOfTheFrameRateWillDo) {
  NpzArrays arrays = Arrays(72);
  arrays.back().first = "mocap_frame_rate";
  WriteNpz(path_, arrays);
  EXPECT_EQ(ReadMotion(path_).frame_rate, 120.0);
}

TEST_F(MotionIo, FaultsAreNamed) {
  ExpectError({{"poses", NpyArray::Doubles({1, 63}, std::vector<double>(63))}},
              "poses has 63 numbers a frame: expected 72 (SMPL)");
  ExpectError({{"poses", NpyArray::Doubles({0, 72}, {})}},
              "poses has no frames");
  ExpectError({{"trans", NpyArray::Doubles({1, 3}, {1, 2, 3})}},
              "trans is f8 (1, 3): expected shape (2, 3)");
  ExpectError({{"trans", NpyArray::Doubles({2, 3}, {1, 2, NAN, 4, 5, 6})}},
              "trans holds nan (value 2): expected finite numbers");
  ExpectError({{"trans", NpyArray::Doubles({2, 3}, {1, 2, 3, 4, -2e6, 6})}},
              "trans of frame 1 holds -2e+06 (value 1): expected at most 1e+06 "
              "m");
  std::vector<double> poses(144);
  poses[75] = 1e200;
  ExpectError({{"poses", NpyArray::Doubles({2, 72}, poses)}},
              "poses of frame 1 holds 1e+200 (value 3): expected at most 1e+06 "
              "rad");
  ExpectError({{"mocap_framerate", NpyArray::Doubles({}, {-30})}},
              "mocap_framerate is -30.000000: expected a positive number");
  ExpectError({{"mocap_frame_rate", NpyArray::Doubles({}, {60})}},
              "mocap_framerate is 120.000000 but mocap_frame_rate is 60");
  ExpectError({{"gender", NpyArray::Doubles({}, {1})}},
              "gender is f8 (): expected text");
  NpzArrays arrays = Arrays(72);
  arrays.pop_back();
  WriteNpz(path_, arrays);
  EXPECT_THAT([&] { ReadMotion(path_); },
              ThrowsMessage<InputError>(HasSubstr("neither mocap_framerate")));
}

}  // namespace
}  // namespace invsim
