// SPDX-License-Identifier: Apache-2.0
#include "invsim/contact/contact_pattern.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace invsim {
namespace {

Contact Coupling(const std::vector<int>& vertices) {
  Contact c;
  c.num_vertices = static_cast<int>(vertices.size());
  std::copy(vertices.begin(), vertices.end(), c.vertex.begin());
  return c;
}

// Ten vertices in a row, each coupled with the next.
class ContactPatternTest : public testing::Test {
 protected:
  static std::shared_ptr<const BlockPattern> Row() {
    BlockPatternBuilder builder(10);
    for (int i = 0; i + 1 < 10; ++i) builder.AddStencil({{i, i + 1}});
    return builder.Build();
  }
  bool Holds(const std::vector<int>& vertices) const {
    return pattern_.pattern()->Holds(vertices);
  }
  bool Covers(const std::vector<std::vector<int>>& stencils) {
    std::vector<Contact> contacts;
    for (const auto& vertices : stencils)
      contacts.push_back(Coupling(vertices));
    const bool changed = pattern_.Cover(contacts);
    for (const auto& vertices : stencils) EXPECT_TRUE(Holds(vertices));
    for (int i = 0; i + 1 < 10; ++i) EXPECT_TRUE(Holds({i, i + 1}));
    return changed;
  }

  std::shared_ptr<const BlockPattern> base_ = Row();
  ContactPattern pattern_{base_};
};

// Nothing is to be analysed anew.
TEST_F(ContactPatternTest, WhatTheEffectsCoupleNeedsNoMore) {
  EXPECT_FALSE(Covers({}));
  EXPECT_FALSE(Covers({{4}, {4}, {6, 7}}));
  EXPECT_EQ(pattern_.pattern(), base_);
}

TEST_F(ContactPatternTest, HoldsEveryPairOfEveryContact) {
  EXPECT_TRUE(Covers({{0, 4, 6, 9}, {2, 8}, {3}}));
  for (const std::vector<int>& pair : {std::vector<int>{9, 0}, {6, 4}, {8, 2}})
    EXPECT_TRUE(Holds(pair));
  // And no more: seven pairs, both ways, beside the base's.
  EXPECT_EQ(pattern_.pattern()->num_blocks(), base_->num_blocks() + 2 * 7);
}

// Contacts that come and go are paid for once.
TEST_F(ContactPatternTest, ContactsThatTakeTurnsChangeItOnlyOnce) {
  EXPECT_TRUE(Covers({{0, 5}}));
  EXPECT_TRUE(Covers({{1, 7}}));
  const auto both = pattern_.pattern();
  for (int step = 0; step < 3; ++step) {
    EXPECT_FALSE(Covers({{0, 5}}));
    EXPECT_FALSE(Covers({{1, 7}}));
    EXPECT_FALSE(Covers({}));
  }
  EXPECT_EQ(pattern_.pattern(), both);
}

// Of three pairs one is in use: those gone by are more.
TEST_F(ContactPatternTest, ForgetsOnceMoreLieIdleThanAreInUse) {
  Covers({{0, 5}});
  Covers({{1, 7}});
  EXPECT_TRUE(Covers({{2, 9}}));
  EXPECT_FALSE(Holds({0, 5}));
  EXPECT_FALSE(Holds({1, 7}));
  // Two new ones beside one that is idle.
  EXPECT_TRUE(Covers({{3, 6}, {4, 8}}));
  EXPECT_TRUE(Holds({2, 9}));
}

TEST_F(ContactPatternTest, ResetLeavesTheEffectsAlone) {
  EXPECT_FALSE(pattern_.Reset());
  Covers({{0, 5}});
  EXPECT_TRUE(pattern_.Reset());
  EXPECT_EQ(pattern_.pattern(), base_);
  EXPECT_FALSE(pattern_.Reset());
  // What was there before does not come back.
  Covers({{1, 7}});
  EXPECT_FALSE(Holds({0, 5}));
}

}  // namespace
}  // namespace invsim
