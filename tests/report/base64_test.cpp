// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/base64.h"

#include <gtest/gtest.h>

namespace invsim {
namespace {

// The test vectors of RFC 4648, section 10.
TEST(Base64, MeetsTheStandardsExamples) {
  EXPECT_EQ(Base64(""), "");
  EXPECT_EQ(Base64("f"), "Zg==");
  EXPECT_EQ(Base64("fo"), "Zm8=");
  EXPECT_EQ(Base64("foo"), "Zm9v");
  EXPECT_EQ(Base64("foob"), "Zm9vYg==");
  EXPECT_EQ(Base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(Base64("foobar"), "Zm9vYmFy");
}

TEST(Base64, TakesAnyByte) {
  EXPECT_EQ(Base64(std::string("\x00\xff\xfe", 3)), "AP/+");
}

}  // namespace
}  // namespace invsim
