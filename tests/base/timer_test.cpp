// SPDX-License-Identifier: Apache-2.0
#include "invsim/base/timer.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace invsim {
namespace {

TEST(TimersTest, AddUpByNameInOrderOfFirstUse) {
  Timers timers;
  timers.Add("solve", 1);
  timers.Add("factorise", 2);
  timers.Add("solve", 3);
  ASSERT_EQ(timers.parts().size(), 2u);
  EXPECT_EQ(timers.parts()[0].name, "solve");
  EXPECT_EQ(timers.parts()[0].seconds, 4);
  EXPECT_EQ(timers.parts()[0].calls, 2);
  EXPECT_EQ(timers.seconds("factorise"), 2);
  EXPECT_EQ(timers.seconds("never"), 0);
}

TEST(TimersTest, AddsAnother) {
  Timers a, b;
  a.Add("x", 1);
  b.Add("x", 2, 5);
  b.Add("y", 4);
  a.Add(b);
  EXPECT_EQ(a.seconds("x"), 3);
  EXPECT_EQ(a.parts()[0].calls, 6);
  EXPECT_EQ(a.seconds("y"), 4);
}

TEST(ScopedTimerTest, TimesItsScope) {
  Timers timers;
  for (int i = 0; i < 2; ++i) {
    ScopedTimer timer(&timers, "sleep");
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_GE(timers.seconds("sleep"), 0.010);  // sleeps are never shorter
  EXPECT_EQ(timers.parts()[0].calls, 2);
}

TEST(ScopedTimerTest, WithoutTimersDoesNothing) {
  ScopedTimer timer(nullptr, "nothing");
}

}  // namespace
}  // namespace invsim
