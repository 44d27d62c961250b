// SPDX-License-Identifier: Apache-2.0
#include "invsim/base/interrupt.h"

#include <gtest/gtest.h>
#include <signal.h>

namespace invsim {
namespace {

int outer_signals = 0;

TEST(InterruptTest, EitherSignalRaisesTheFlag) {
  for (const int signal : {SIGINT, SIGTERM}) {
    InterruptGuard guard;
    EXPECT_FALSE(InterruptRequested());
    raise(signal);
    EXPECT_TRUE(InterruptRequested());
  }
}

TEST(InterruptTest, GivesTheSignalBack) {
  const auto old = signal(SIGINT, [](int) { ++outer_signals; });
  { InterruptGuard guard; }
  raise(SIGINT);
  EXPECT_EQ(outer_signals, 1);
  EXPECT_FALSE(InterruptRequested());
  signal(SIGINT, old);
}

TEST(InterruptDeathTest, TheSameSignalAgainEndsTheProcess) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        InterruptGuard guard;
        raise(SIGTERM);
        raise(SIGTERM);
      },
      testing::KilledBySignal(SIGTERM),
      "");
}

}  // namespace
}  // namespace invsim
