// SPDX-License-Identifier: Apache-2.0
#include "invsim/base/progress.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

namespace invsim {
namespace {

TEST(ClockTextTest, Examples) {
  EXPECT_EQ(ClockText(0), "0:00");
  EXPECT_EQ(ClockText(6.6), "0:07");
  EXPECT_EQ(ClockText(59.7), "1:00");
  EXPECT_EQ(ClockText(754), "12:34");
  EXPECT_EQ(ClockText(3723), "1:02:03");
  EXPECT_EQ(ClockText(-1), "0:00");
}

class ProgressTest : public testing::Test {
 protected:
  Progress::Clock clock() {
    return [this] { return now_; };
  }

  std::ostringstream out_;
  double now_ = 100;
};

TEST_F(ProgressTest, OneLinePerItemWithTimeLeft) {
  {
    Progress progress(&out_, {}, "frames", 3, clock());
    now_ += 10;
    progress.Advance("2 contacts");
    now_ += 20;
    progress.Advance();
    now_ += 30;
    progress.Advance("done");
  }
  EXPECT_EQ(out_.str(),
            "frames 1/3  eta 0:20  2 contacts\n"
            "frames 2/3  eta 0:15\n"
            "frames 3/3  in 1:00  done\n");
}

TEST_F(ProgressTest, SeveralItemsAtOnce) {
  {
    Progress progress(&out_, {}, "percent", 100, clock());
    now_ += 10;
    progress.Advance("", 25);
    now_ += 10;
    progress.Advance("", 75);
  }
  EXPECT_EQ(out_.str(),
            "percent 25/100  eta 0:30\n"
            "percent 100/100  in 0:20\n");
}

TEST_F(ProgressTest, BarRedrawsItsLineAndWipesTheOld) {
  {
    Progress progress(&out_, {.bar = true}, "n", 2, clock());
    now_ += 1;
    progress.Advance("long note");
    now_ += 1;
    progress.Advance();
  }
  EXPECT_EQ(out_.str(),
            "\r[############------------] n 1/2  eta 0:01  long note"
            "\r[########################] n 2/2  in 0:02            \n");
}

TEST_F(ProgressTest, BarIsNotRedrawnTooOften) {
  Progress progress(&out_, {.bar = true}, "n", 1000, clock());
  for (int i = 0; i < 500; ++i) {
    now_ += 0.001;
    progress.Advance();
  }
  const std::string text = out_.str();
  EXPECT_LE(std::count(text.begin(), text.end(), '\r'), 6);
}

TEST_F(ProgressTest, ColorOnlyIfAskedFor) {
  Progress(&out_, {.bar = true}, "n", 1, clock()).Advance();
  EXPECT_EQ(out_.str().find('\x1b'), std::string::npos);
  Progress(&out_, {.bar = true, .color = true}, "n", 1, clock()).Advance();
  EXPECT_NE(out_.str().find('\x1b'), std::string::npos);
}

TEST_F(ProgressTest, NothingWithoutAStream) {
  Progress progress(nullptr, {.bar = true}, "n", 1);
  progress.Advance();
}

TEST_F(ProgressTest, APipeIsNoTerminal) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  EXPECT_FALSE(StyleFor(ends[1]).bar);
  EXPECT_FALSE(StyleFor(ends[1]).color);
  close(ends[0]);
  close(ends[1]);
}

// A pseudo-terminal stands in for the user's.
TEST_F(ProgressTest, ATerminalHasABarAndNoColorIsHonoured) {
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
  if (terminal < 0) GTEST_SKIP() << "no pseudo-terminals here";
  setenv("TERM", "xterm", 1);
  unsetenv("NO_COLOR");
  EXPECT_TRUE(StyleFor(terminal).bar);
  EXPECT_TRUE(StyleFor(terminal).color);
  setenv("NO_COLOR", "1", 1);
  EXPECT_TRUE(StyleFor(terminal).bar);
  EXPECT_FALSE(StyleFor(terminal).color);
  setenv("TERM", "dumb", 1);
  EXPECT_FALSE(StyleFor(terminal).bar);
  unsetenv("NO_COLOR");
  close(terminal);
}

}  // namespace
}  // namespace invsim
