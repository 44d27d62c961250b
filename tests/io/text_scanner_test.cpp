// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/text_scanner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "error_matcher.h"

namespace invsim {
namespace {

TEST(TextScannerTest, WalksThroughLinesAndWords) {
  const std::string name = "t";
  TextScanner scanner("\n # all comment\r\n a\tb # c\r\rd", name, '#');
  ASSERT_TRUE(scanner.NextLine());
  EXPECT_EQ(scanner.line(), 3);
  EXPECT_EQ(scanner.Word(), "a");
  EXPECT_EQ(scanner.Word(), "b");
  EXPECT_EQ(scanner.Word(), "");
  EXPECT_EQ(scanner.Word(), "");
  ASSERT_TRUE(scanner.NextLine());
  EXPECT_EQ(scanner.line(), 5);
  EXPECT_EQ(scanner.Word(), "d");
  EXPECT_FALSE(scanner.NextLine());
  EXPECT_FALSE(scanner.NextLine());
}

TEST(TextScannerTest, SkipsWhatIsLeftOfALine) {
  const std::string name = "t";
  TextScanner scanner("a b\nc", name, 0, 0, 10);
  ASSERT_TRUE(scanner.NextLine());
  ASSERT_TRUE(scanner.NextLine());
  EXPECT_EQ(scanner.line(), 11);
  EXPECT_EQ(scanner.Word(), "c");
}

TEST(TextScannerTest, JoinsContinuedLines) {
  const std::string name = "t";
  TextScanner scanner("a \\\r\nb \\c\nd", name, '#', '\\');
  ASSERT_TRUE(scanner.NextLine());
  EXPECT_EQ(scanner.Word(), "a");
  EXPECT_EQ(scanner.Word(), "b");
  EXPECT_EQ(scanner.line(), 2);
  EXPECT_EQ(scanner.Word(), "\\c");
  ASSERT_TRUE(scanner.NextLine());
  EXPECT_EQ(scanner.line(), 3);
}

TEST(TextScannerTest, ReadsNumbers) {
  const std::string name = "t";
  const TextScanner scanner("", name, 0);
  EXPECT_EQ(scanner.ToNumber("+1.5e-3", "n"), 1.5e-3);
  EXPECT_EQ(scanner.ToNumber("-.5", "n"), -0.5);
  EXPECT_EQ(scanner.ToNumber("4.9e-324", "n"), 4.9e-324);
  EXPECT_EQ(scanner.ToNumber("1e-400", "n"), 0.0);
  EXPECT_TRUE(std::isinf(scanner.ToNumber("1e400", "n")));
  EXPECT_TRUE(std::isnan(scanner.ToNumber("-nan", "n")));
  EXPECT_EQ(scanner.ToInteger("-9223372036854775808", "n"),
            std::numeric_limits<std::int64_t>::min());
  for (const char* word : {"", "+", "+-1", "1,5", "0x10", "1e", "one"}) {
    EXPECT_THAT([&] { scanner.ToNumber(word, "n"); },
                ThrowsInputError("expected a number (n)"))
        << word;
    EXPECT_THAT([&] { scanner.ToInteger(word, "n"); },
                ThrowsInputError("expected a whole number (n)"))
        << word;
  }
}

TEST(TextScannerTest, ShowsHostileWordsInOneShortLine) {
  EXPECT_EQ(Quoted("a\nb\x1b[31m\xff"), "'a?b?[31m?'");
  EXPECT_EQ(Quoted(std::string(100, 'a')), "'" + std::string(40, 'a') + "...'");
}

}  // namespace
}  // namespace invsim
