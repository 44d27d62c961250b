// SPDX-License-Identifier: Apache-2.0
#include "../../src/base/toml_letters.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace invsim {
namespace {

TEST(TomlLetters, BytesBeyondAsciiAndPercentGoInAsHexadecimals) {
  EXPECT_EQ(Encoded("a = 'h\u00f6he'\n"), "a = 'h%C3%B6he'\n");
  EXPECT_EQ(Encoded("100 %"), "100 %25");
}

// Whatever the bytes, text that looks like a code among them.
TEST(TomlLetters, EveryTextComesOutAsItWentIn) {
  std::string text = "%41 %% %2525 100%";
  for (int byte = 0; byte < 256; ++byte) text += static_cast<char>(byte);
  const std::string encoded = Encoded(text);
  EXPECT_TRUE(std::all_of(encoded.begin(), encoded.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x80;
  }));
  EXPECT_EQ(Decoded(encoded), text);
  EXPECT_EQ(Decoded(Encoded(encoded)), encoded);
}

// The first and the last of each length, and those beside the surrogates.
TEST(TomlLetters, LettersOfEveryLengthAreTaken) {
  for (const char* letter : {"\x7f",
                             "\xc2\x80",
                             "\xdf\xbf",
                             "\xe0\xa0\x80",
                             "\xed\x9f\xbf",
                             "\xee\x80\x80",
                             "\xef\xbf\xbf",
                             "\xf0\x90\x80\x80",
                             "\xf4\x8f\xbf\xbf"}) {
    EXPECT_EQ(LetterComplaint(letter), "") << Encoded(letter);
    EXPECT_EQ(LetterComplaint("a" + std::string(letter) + "z"), "")
        << Encoded(letter);
  }
}

// Sequences that other readers take for some letter, or that end too early.
TEST(TomlLetters, WhatIsNoLetterIsRefused) {
  for (const char* bytes : {"\x80",              // no beginning
                            "\xbf\xbf",          //
                            "\xc3",              // no end
                            "\xe2\x82",          //
                            "\xf0\x9f\x98",      //
                            "\xc3z",             // broken off
                            "\xe2\x82z",         //
                            "\xc0\xa5",          // a long '%'
                            "\xc1\xbf",          //
                            "\xe0\x9f\xbf",      //
                            "\xf0\x8f\xbf\xbf",  //
                            "\xed\xa0\x80",      // surrogates
                            "\xed\xbf\xbf",      //
                            "\xf4\x90\x80\x80",  // beyond the last letter
                            "\xf5\x80\x80\x80"})
    for (const char* before : {"", "\u20ac"})
      EXPECT_EQ(LetterComplaint(before + std::string(bytes)),
                "expected text in UTF-8")
          << Encoded(bytes);
  // What would end it lies behind the end of the text.
  EXPECT_NE(LetterComplaint(std::string_view("\u20ac").substr(0, 2)), "");
}

// The long escape too; other escapes are the parser's business.
TEST(TomlLetters, PercentMustNotBeWrittenAsAnEscape) {
  EXPECT_EQ(LetterComplaint("a = \"\\U00000025\""),
            "\\U00000025: expected the letter % itself");
  EXPECT_EQ(LetterComplaint("a = \"\\u00e9 \\U0001F600\""), "");
}

}  // namespace
}  // namespace invsim
