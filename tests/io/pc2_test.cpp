// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/pc2.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <limits>

#include "error_matcher.h"

namespace invsim {
namespace {

PointCache SomeCache() {
  PointCache cache;
  for (int s = 0; s < 3; ++s) {
    cache.samples.push_back(Points::Constant(3, 2, 0.25 * s));
    cache.samples.back()(1, 1) = 0.1;
  }
  cache.start_frame = 5;
  cache.frames_per_sample = 0.5;
  return cache;
}

TEST(Pc2Test, HasTheDocumentedBytes) {
  const std::string bytes = FormatPc2(SomeCache());
  ASSERT_EQ(bytes.size(), 32 + 3 * 2 * 12);
  EXPECT_EQ(bytes.substr(0, 12), std::string("POINTCACHE2\0", 12));
  const auto int_at = [&](std::size_t at) {
    std::int32_t value;
    std::memcpy(&value, &bytes[at], 4);
    return value;
  };
  const auto float_at = [&](std::size_t at) {
    float value;
    std::memcpy(&value, &bytes[at], 4);
    return value;
  };
  EXPECT_EQ(int_at(12), 1);
  EXPECT_EQ(int_at(16), 2);
  EXPECT_EQ(float_at(20), 5.0f);
  EXPECT_EQ(float_at(24), 0.5f);
  EXPECT_EQ(int_at(28), 3);
  EXPECT_EQ(float_at(32 + 16), 0.1f);       // y of the second point
  EXPECT_EQ(float_at(32 + 24 + 8), 0.25f);  // z of the second sample
}

TEST(Pc2Test, ReadsWhatItWrites) {
  const std::string path = ::testing::TempDir() + "pc2_test.pc2";
  WritePc2(path, SomeCache());
  const PointCache same = ReadPc2(path);
  std::filesystem::remove(path);
  ASSERT_EQ(same.samples.size(), 3);
  EXPECT_EQ(same.start_frame, 5);
  EXPECT_EQ(same.frames_per_sample, 0.5);
  for (int s = 0; s < 3; ++s) {
    EXPECT_TRUE(same.samples[s].isApprox(SomeCache().samples[s], 1e-7)) << s;
  }
  EXPECT_EQ(ParsePc2(FormatPc2({}), "t").samples.size(), 0);
}

TEST(Pc2Test, RefusesSamplesThatDoNotFit) {
  PointCache cache = SomeCache();
  cache.samples[1] = Points::Zero(3, 3);
  EXPECT_THROW(FormatPc2(cache), Error);
}

TEST(Pc2Test, RefusesDamage) {
  std::string bytes = FormatPc2(SomeCache());
  EXPECT_THAT([&] { ParsePc2(bytes.substr(0, 31), "t.pc2"); },
              ThrowsInputError("t.pc2: expected a point cache"));
  EXPECT_THAT([&] { ParsePc2(bytes.substr(0, 103), "t.pc2"); },
              ThrowsInputError("t.pc2: 71 bytes after the header: expected 12 "
                               "for each point of 3 samples of 2"));
  EXPECT_THAT([&] { ParsePc2(bytes + "x", "t.pc2"); },
              ThrowsInputError("t.pc2: 73 bytes after the header"));
  std::string huge = bytes;
  std::memset(&huge[16], 0x7f, 4);
  std::memset(&huge[28], 0x7f, 4);
  EXPECT_THAT([&] { ParsePc2(huge, "t.pc2"); },
              ThrowsInputError("of 2139062143 samples of 2139062143"));
  std::string nothing = bytes.substr(0, 32);
  std::memset(&nothing[16], 0, 4);
  std::memset(&nothing[28], 0x7f, 4);
  EXPECT_THAT([&] { ParsePc2(nothing, "t.pc2"); },
              ThrowsInputError("of 2139062143 samples of 0"));
  std::swap_ranges(&nothing[16], &nothing[20], &nothing[28]);
  EXPECT_THAT([&] { ParsePc2(nothing, "t.pc2"); },
              ThrowsInputError("of 0 samples of 2139062143"));
  // 12 bytes for each of so many points is 2^64 + 260.
  std::string wrapped = bytes.substr(0, 32) + std::string(260, '\0');
  const std::int32_t points = 889509163;
  const std::int32_t samples = 1728176321;
  std::memcpy(&wrapped[16], &points, 4);
  std::memcpy(&wrapped[28], &samples, 4);
  EXPECT_THAT([&] { ParsePc2(wrapped, "t.pc2"); },
              ThrowsInputError("t.pc2: 260 bytes after the header"));
  std::string negative = bytes;
  negative[31] = '\x80';
  EXPECT_THAT([&] { ParsePc2(negative, "t.pc2"); },
              ThrowsInputError("samples: expected 0 or more"));
  std::string version = bytes;
  version[12] = 2;
  EXPECT_THAT([&] { ParsePc2(version, "t.pc2"); },
              ThrowsInputError("t.pc2: version 2: expected 1"));
  PointCache no_start = SomeCache();
  no_start.start_frame = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT([&] { ParsePc2(FormatPc2(no_start), "t.pc2"); },
              ThrowsInputError("expected finite numbers"));
  PointCache infinite = SomeCache();
  infinite.samples[2](0, 0) = std::numeric_limits<double>::infinity();
  EXPECT_THAT([&] { ParsePc2(FormatPc2(infinite), "t.pc2"); },
              ThrowsInputError("t.pc2: sample 2 (from 0): expected finite"));
}

}  // namespace
}  // namespace invsim
