// SPDX-License-Identifier: Apache-2.0
#include "invsim/base/threads.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>

#include "invsim/base/error.h"

namespace invsim {
namespace {

class ThreadsTest : public testing::Test {
 protected:
  ~ThreadsTest() override { SetThreads(0); }
};

TEST_F(ThreadsTest, SetsAndResets) {
  SetThreads(3);
  EXPECT_EQ(NumThreads(), 3);
  SetThreads(1);
  EXPECT_EQ(NumThreads(), 1);
  SetThreads(5);
  EXPECT_EQ(NumThreads(), 5);
  SetThreads(0);
  EXPECT_GE(NumThreads(), 1);
  EXPECT_THROW(SetThreads(-1), UsageError);
}

TEST_F(ThreadsTest, HoldsBlasToOneThread) {
  // The linker leaves out what this program does not call; load it.
  if (!dlopen("libopenblas.so.0", RTLD_NOW | RTLD_GLOBAL))
    GTEST_SKIP() << "OpenBLAS is not installed";
  using SetThreadsFunction = void (*)(int);
  using GetThreadsFunction = int (*)();
  const auto set = reinterpret_cast<SetThreadsFunction>(
      dlsym(RTLD_DEFAULT, "openblas_set_num_threads"));
  const auto get = reinterpret_cast<GetThreadsFunction>(
      dlsym(RTLD_DEFAULT, "openblas_get_num_threads"));
  ASSERT_TRUE(set && get);
  set(2);
  ASSERT_EQ(get(), 2);
  SetThreads(2);
  EXPECT_EQ(get(), 1);
}

TEST_F(ThreadsTest, VisitsEveryIndexOnce) {
  for (const int n : {0, 1, 7, 8, 9, 1000}) {
    std::vector<std::atomic<int>> visits(n);
    ParallelFor(n, 8, [&](int i) { ++visits[i]; });
    for (int i = 0; i < n; ++i) EXPECT_EQ(visits[i], 1) << i << " of " << n;
  }
}

TEST_F(ThreadsTest, PiecesHaveTheAskedSize) {
  std::mutex mutex;
  std::set<std::pair<int, int>> pieces;
  ParallelForPieces(10, 4, [&](int begin, int end) {
    const std::lock_guard<std::mutex> lock(mutex);
    pieces.insert({begin, end});
  });
  EXPECT_EQ(pieces, (std::set<std::pair<int, int>>{{0, 4}, {4, 8}, {8, 10}}));
}

TEST_F(ThreadsTest, PiecesNearTheLargestIntegerDoNotOverflow) {
  constexpr int kMax = std::numeric_limits<int>::max();
  std::atomic<int> last = 0;
  ParallelForPieces(kMax, kMax - 1, [&](int begin, int end) {
    if (end == kMax) last = end - begin;
  });
  EXPECT_EQ(last, 1);
}

TEST_F(ThreadsTest, OneThreadMeansOneThread) {
  SetThreads(1);
  std::mutex mutex;
  std::set<std::thread::id> seen;
  ParallelFor(1000, 1, [&](int) {
    const std::lock_guard<std::mutex> lock(mutex);
    seen.insert(std::this_thread::get_id());
  });
  EXPECT_EQ(seen, std::set<std::thread::id>{std::this_thread::get_id()});
}

TEST_F(ThreadsTest, SumIsTheSameForEveryThreadCount) {
  constexpr int kTerms = 100001;
  const auto sum = [] {
    return ParallelSum(kTerms, 100, 0.0, [](int begin, int end) {
      double part = 0;
      for (int i = begin; i < end; ++i) part += std::sin(i) * std::exp(i % 40);
      return part;
    });
  };
  SetThreads(1);
  const double one = sum();
  SetThreads(4);
  for (int repeat = 0; repeat < 5; ++repeat) EXPECT_EQ(sum(), one);
}

TEST_F(ThreadsTest, SumOfNothingIsZero) {
  EXPECT_EQ(ParallelSum(0, 10, 2.5, [](int, int) { return 1.0; }), 2.5);
}

TEST_F(ThreadsTest, ExceptionsComeOut) {
  EXPECT_THROW(ParallelFor(100,
                           1,
                           [](int i) {
                             if (i == 50) throw std::runtime_error("fifty");
                           }),
               std::runtime_error);
}

}  // namespace
}  // namespace invsim
