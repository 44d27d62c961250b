// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/json_record.h"

#include <gmock/gmock.h>

#include "error_matcher.h"

namespace invsim {
namespace {

JsonRecord Parse(const std::string& text) {
  return JsonRecord::Parse(text, "a.json");
}

TEST(JsonRecord, GivesWhatIsThereAndFallbacks) {
  const JsonRecord record =
      Parse(R"({"body": "b.npz", "inputs": {"friction": 0.5, "none": null},)"
            R"( "exit_code": -3, "arguments": ["fit", "-q"]})");
  EXPECT_EQ(record.Text("body"), "b.npz");
  EXPECT_EQ(record.Text("garment", "g"), "g");
  EXPECT_EQ(record.Number("inputs.friction", 1), 0.5);
  EXPECT_EQ(record.Number("inputs.none", 7), 7);
  EXPECT_EQ(record.Number("inputs.more.below", 7), 7);
  EXPECT_EQ(record.Integer("exit_code", 0), -3);
  EXPECT_EQ(record.Texts("arguments"), (std::vector<std::string>{"fit", "-q"}));
  EXPECT_TRUE(record.Texts("none").empty());
  EXPECT_TRUE(record.Has("inputs.friction"));
  EXPECT_FALSE(record.Has("inputs.none"));
  EXPECT_FALSE(JsonRecord::Read("/no/such/file").Has("body"));
}

TEST(JsonRecord, SaysWhatIsOfAnotherType) {
  const JsonRecord record =
      Parse(R"({"n": 5, "t": "x", "l": [1], "o": {"k": true}, "nulls": [null],)"
            R"( "half": 0.5, "huge": 1e300})");
  EXPECT_THAT([&] { record.Text("n"); },
              ThrowsInputError("a.json: n: expected a text, found a number"));
  EXPECT_THAT([&] { record.Text("l"); },
              ThrowsInputError("a.json: l: expected a text, found a list"));
  EXPECT_THAT([&] { record.Number("t", 0); },
              ThrowsInputError("t: expected a number, found a text"));
  EXPECT_THAT([&] { record.Number("o.k", 0); },
              ThrowsInputError("o.k: expected a number, found true or false"));
  EXPECT_THAT([&] { record.Number("t.below", 0); },
              ThrowsInputError("a.json: t: expected an object, found a text"));
  EXPECT_THAT([&] { record.Integer("half", 0); },
              ThrowsInputError("half: expected a whole number"));
  EXPECT_THAT([&] { record.Integer("huge", 0); },
              ThrowsInputError("huge: expected a whole number"));
  EXPECT_THAT([&] { record.Texts("o"); },
              ThrowsInputError("expected a list of texts, found an object"));
  EXPECT_THAT([&] { record.Texts("l"); },
              ThrowsInputError("found a number in it"));
  EXPECT_THAT([&] { record.Texts("nulls"); },
              ThrowsInputError("found null in it"));
}

TEST(JsonRecord, RefusesWhatIsNoObject) {
  for (const char* text : {"", "{", "5", "[1]", "null", "{\"a\": \"\xff\"}"})
    EXPECT_THAT([&] { Parse(text); },
                ThrowsInputError("a.json: expected a JSON object"))
        << text;
}

}  // namespace
}  // namespace invsim
