// SPDX-License-Identifier: Apache-2.0
#include "invsim/base/config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "invsim/base/error.h"

namespace invsim {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

std::string ErrorOf(const std::string& toml) {
  try {
    Config::FromText(toml, "scene.toml");
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no error";
}

ConfigValue Parsed(const std::string& text) {
  Config config;
  config.Set("key", text, "--set");
  return config.entries().at("key").value;
}

TEST(ConfigTest, FlattensTablesToDottedKeys) {
  const Config config = Config::FromText(
      "name = 'shirt'\n"
      "[step]\n"
      "substeps = 3\n"
      "dt = 0.5\n"
      "[effects.wind]\n"
      "on = true\n"
      "velocity = [0, 1.5, 2]\n"
      "list = ['a', 'b']\n",
      "scene.toml");
  const auto& entries = config.entries();
  EXPECT_EQ(entries.size(), 6u);
  EXPECT_EQ(entries.at("name").value, ConfigValue("shirt"));
  EXPECT_EQ(entries.at("step.substeps").value, ConfigValue(std::int64_t{3}));
  EXPECT_EQ(entries.at("step.dt").value, ConfigValue(0.5));
  EXPECT_EQ(entries.at("effects.wind.on").value, ConfigValue(true));
  EXPECT_EQ(entries.at("effects.wind.velocity").value,
            ConfigValue(std::vector<double>{0, 1.5, 2}));
  EXPECT_EQ(entries.at("effects.wind.list").value,
            ConfigValue(std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(config.tables().size(), 3u);
  EXPECT_EQ(config.tables().at("effects.wind"), "scene.toml:5:10");
}

TEST(ConfigTest, RemembersLineAndColumnOfEachKey) {
  const Config config =
      Config::FromText("a = 1\n\n  b.c = 2\n[d]\ne = 3\n", "f.toml");
  EXPECT_EQ(config.entries().at("a").origin, "f.toml:1:1");
  EXPECT_EQ(config.entries().at("b.c").origin, "f.toml:3:5");
  EXPECT_EQ(config.entries().at("d.e").origin, "f.toml:5:1");
}

TEST(ConfigTest, RefusesWhatIsNotToml) {
  EXPECT_THAT(ErrorOf("a = 1\nb = = 2\n"), StartsWith("scene.toml:2:"));
  EXPECT_THAT(ErrorOf("a = 1\na = 2\n"), StartsWith("scene.toml:2:"));
  EXPECT_EQ(ErrorOf("a = 1\nb = 2\n"), "no error");
}

TEST(ConfigTest, RefusesValuesNoOptionHas) {
  for (const char* value :
       {"2020-01-01", "[[[1, 2]], [3]]", "[2020-01-01]", "[{a = 1}]"}) {
    const std::string error = ErrorOf("x = 0\nkey = " + std::string(value));
    EXPECT_THAT(error, StartsWith("scene.toml:2:1: key: expected")) << value;
  }
}

// What sweeps try in turn.
TEST(ConfigTest, ListsMayHoldAnything) {
  for (const auto& [toml, elements] :
       std::vector<std::pair<std::string, std::vector<std::string>>>{
           {"[true, false]", {"true", "false"}},
           {"[[1.5, 2.0], []]", {"[1.5, 2.0]", "[]"}},
           {R"(["auto", ["a", "b"], 3])", {R"("auto")", R"(["a", "b"])", "3"}}})
    EXPECT_EQ(Parsed(toml), ConfigValue(ConfigList{elements})) << toml;
  const std::string text = R"([true, ["a", "b"]])";
  EXPECT_EQ(TomlText(Parsed(text)), text);
}

TEST(ConfigTest, NamesAFileThatCannotBeRead) {
  for (const std::string& path :
       {std::string("no/such/file.toml"), testing::TempDir()}) {
    try {
      Config::FromFile(path);
      FAIL() << path;
    } catch (const UsageError& error) {
      EXPECT_THAT(error.what(), StartsWith(path + ": cannot be read"));
    }
  }
}

// A key of many parts is a table in a table in a table: parts beyond the stack
// would end the process.
TEST(ConfigTest, RefusesKeysThatAreNoOptions) {
  std::string deep;
  for (int i = 0; i < 16000; ++i) deep += "a.";
  EXPECT_THAT(ErrorOf(deep + "a = 1"),
              EndsWith("expected a key of at most 16 parts"));
  EXPECT_EQ(
      ErrorOf(deep + deep + "a = 1"),
      "scene.toml: 64005 bytes: expected a configuration of at most 32768");
  EXPECT_EQ(
      ErrorOf("[s]\n\"a\\nb\" = 1"),
      "scene.toml:2:1: key \"s.a\\u000ab\": expected no control character");
}

TEST(ConfigTest, TakesLettersBeyondAsciiInTextsAndCommentsOnly) {
  const std::string good =
      "# h\u00f6he\n\"h\u00f6he\" = '\u00fc' # \u00e9\n"
      "b = \"\"\"a\\\"\"\n\u20ac\"\"\"";
  const Config config = Config::FromText("\ufeff" + good, "f.toml");
  EXPECT_EQ(config.entries().at("h\u00f6he").value, ConfigValue("\u00fc"));
  EXPECT_EQ(config.entries().at("b").value, ConfigValue("a\"\"\n\u20ac"));
  EXPECT_THAT(ErrorOf(good + "\nc = \u02d41"),
              StartsWith("scene.toml:5:5: Error while parsing value"));
  EXPECT_EQ(ErrorOf("a = '\xff'"), "scene.toml: expected text in UTF-8");
  EXPECT_EQ(ErrorOf("a = '\xf8\x90\x80\x80'"),
            "scene.toml: expected text in UTF-8");
  EXPECT_EQ(ErrorOf("a = \"\\u0025\""),
            "scene.toml: \\u0025: expected the letter % itself");
  EXPECT_EQ(Config::FromText("a = '100 %41'", "f").entries().at("a").value,
            ConfigValue("100 %41"));
  Config set;
  set.Set("key", "h\u00f6he", "--set");
  EXPECT_EQ(set.entries().at("key").value, ConfigValue("h\u00f6he"));
}

TEST(ConfigTest, ReadsAFile) {
  const std::string path = testing::TempDir() + "config_test.toml";
  std::ofstream(path) << "\n a = 1\n";
  const Config config = Config::FromFile(path);
  EXPECT_EQ(config.entries().at("a").origin, path + ":2:2");
  std::ofstream(path) << "";
  EXPECT_TRUE(Config::FromFile(path).entries().empty());
  std::filesystem::remove(path);
}

TEST(ConfigTest, LaterSourcesWin) {
  Config config = Config::FromText("a = 1\nb = 2\n[c]\n", "first.toml");
  config.Merge(Config::FromText("b = 3\n[d]\n", "second.toml"));
  config.Assign("e.f=4", "--set");
  config.Assign("a=5", "--set");
  EXPECT_EQ(config.entries().at("a").value, ConfigValue(std::int64_t{5}));
  EXPECT_EQ(config.entries().at("a").origin, "--set");
  EXPECT_EQ(config.entries().at("b").value, ConfigValue(std::int64_t{3}));
  EXPECT_EQ(config.entries().at("b").origin, "second.toml:1:1");
  EXPECT_EQ(config.entries().at("e.f").value, ConfigValue(std::int64_t{4}));
  EXPECT_EQ(config.tables().size(), 2u);
}

TEST(ConfigTest, AssignmentNeedsKeyAndValue) {
  Config config;
  EXPECT_THROW(config.Assign("step.substeps", "--set"), UsageError);
  EXPECT_THROW(config.Assign("=3", "--set"), UsageError);
  config.Assign("a=b=c", "--set");
  EXPECT_EQ(config.entries().at("a").value, ConfigValue("b=c"));
  config.Assign("empty=", "--set");
  EXPECT_EQ(config.entries().at("empty").value, ConfigValue(""));
}

TEST(ConfigTest, CommandLineValuesAreTomlOrPlainText) {
  EXPECT_EQ(Parsed("3"), ConfigValue(std::int64_t{3}));
  EXPECT_EQ(Parsed("-2.5e-3"), ConfigValue(-2.5e-3));
  EXPECT_EQ(Parsed("true"), ConfigValue(true));
  EXPECT_EQ(Parsed("[1, 2]"), ConfigValue(std::vector<double>{1, 2}));
  EXPECT_EQ(Parsed("[]"), ConfigValue(std::vector<double>{}));
  EXPECT_EQ(Parsed("['a']"), ConfigValue(std::vector<std::string>{"a"}));
  EXPECT_EQ(Parsed("'12'"), ConfigValue("12"));
  EXPECT_EQ(Parsed("cotton"), ConfigValue("cotton"));
  EXPECT_EQ(Parsed("out/run 1"), ConfigValue("out/run 1"));
  EXPECT_EQ(Parsed("2020-01-01"), ConfigValue("2020-01-01"));
  EXPECT_EQ(Parsed("12#3"), ConfigValue("12#3"));
  EXPECT_EQ(Parsed("1\nb = 2"), ConfigValue("1\nb = 2"));
}

TEST(TomlTextTest, ReadsBackTheSame) {
  const double third = 1.0 / 3.0;
  const std::vector<ConfigValue> values = {
      true,
      std::numeric_limits<std::int64_t>::min(),
      1.0,
      third,
      -1e300,
      std::numeric_limits<double>::denorm_min(),
      std::numeric_limits<double>::infinity(),
      "plain",
      "quote \" backslash \\ tab \t line\nbell \a",
      "umlaut \xc3\xbc # not a comment",
      std::vector<double>{0, third, 1e22},
      std::vector<double>{},
      std::vector<std::string>{"a, b", "]"}};
  for (const ConfigValue& value : values) {
    const std::string text = TomlText(value);
    const Config config = Config::FromText("key = " + text, "f.toml");
    EXPECT_EQ(config.entries().at("key").value, value) << text;
  }
}

TEST(TomlTextTest, IsShort) {
  EXPECT_EQ(TomlText(0.1), "0.1");
  EXPECT_EQ(TomlText(2.0), "2.0");
  EXPECT_EQ(TomlText(std::int64_t{2}), "2");
  EXPECT_EQ(TomlText(std::vector<double>{1, 0.25}), "[1.0, 0.25]");
}

}  // namespace
}  // namespace invsim
