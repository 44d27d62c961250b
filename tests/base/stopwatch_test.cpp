// SPDX-License-Identifier: Apache-2.0
#include "invsim/base/stopwatch.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace invsim {
namespace {

TEST(ProcessorStopwatch, CountsWorkAndNotWaiting) {
  const Stopwatch wall;
  const ProcessorStopwatch processor;
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_GE(wall.seconds(), 0.2);
  EXPECT_LT(processor.seconds(), 0.1);
  const double before = processor.seconds();
  volatile double sum = 0;
  while (processor.seconds() < before + 0.02) sum = sum + 1;
  EXPECT_GT(wall.seconds(), 0.2 + 0.015);
}

}  // namespace
}  // namespace invsim
