// SPDX-License-Identifier: Apache-2.0
#include "invsim/base/names.h"

#include <gtest/gtest.h>

namespace invsim {
namespace {

const std::vector<std::string> kNames = {
    "bending", "gravity", "step.substeps", "step.newton_iterations"};

TEST(EditDistanceTest, CountsEditsAndSwaps) {
  EXPECT_EQ(EditDistance("", ""), 0);
  EXPECT_EQ(EditDistance("", "abc"), 3);
  EXPECT_EQ(EditDistance("abc", ""), 3);
  EXPECT_EQ(EditDistance("kitten", "sitting"), 3);
  EXPECT_EQ(EditDistance("sitting", "kitten"), 3);
  EXPECT_EQ(EditDistance("gravity", "garvity"), 1);
}

TEST(EditDistanceTest, IgnoresCaseAndDashes) {
  EXPECT_EQ(EditDistance("Soft-L1", "soft_l1"), 0);
}

TEST(NearestNameTest, FindsTheNearNameOnly) {
  EXPECT_EQ(NearestName("bendng", kNames), "bending");
  EXPECT_EQ(NearestName("grvaity", kNames), "gravity");
  EXPECT_EQ(NearestName("stpe.substeps", kNames), "step.substeps");
  EXPECT_EQ(NearestName("friction", kNames), "");
  EXPECT_EQ(NearestName("bending", {}), "");
}

TEST(NearestNameTest, FindsANameInAnotherSection) {
  EXPECT_EQ(NearestName("substeps", kNames), "step.substeps");
  EXPECT_EQ(NearestName("contact.substep", kNames), "step.substeps");
}

TEST(UnknownNameTest, SuggestsOrLists) {
  EXPECT_EQ(UnknownName("effect", "gravty", kNames),
            "unknown effect 'gravty'; did you mean 'gravity'?");
  EXPECT_EQ(UnknownName("loss", "zzz", {"huber", "cauchy"}),
            "unknown loss 'zzz'; known: huber, cauchy");
  EXPECT_EQ(UnknownName("loss", "zzz", {}),
            "unknown loss 'zzz'; none is known");
}

}  // namespace
}  // namespace invsim
