// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/material_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "invsim/base/error.h"

namespace invsim {
namespace {

constexpr char kStretching[] =
    "[[1,2,3,4],[5,6,7,8],[9,10,11,12],[13,14,15,16],[17,-18,19,20],"
    "[21,22,23,24]]";
constexpr char kBending[] =
    "[[1e-6,2e-6,3e-6,4e-6,5e-6],[6e-6,7e-6,8e-6,9e-6,1e-5],"
    "[1e-6,1e-6,1e-6,1e-6,1e-6]]";

std::string Write(const std::string& text) {
  const std::string path = testing::TempDir() + "fabric-one.json";
  std::ofstream(path) << text;
  return path;
}

std::string Fabric(const std::string& density,
                   const std::string& stretching,
                   const std::string& bending) {
  return "{\"density\": " + density + ", \"stretching\": " + stretching +
         ", \"bending\": " + bending + ", \"colour\": \"gray\"}";
}

std::string ErrorOf(const std::string& text) {
  const std::string path = Write(text);
  try {
    ReadMaterial(path);
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.find(path + ": "), 0u) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos);
    return what.substr(path.size() + 2);
  }
  return "no error";
}

TEST(ReadMaterial, ReadsAMeasuredFabric) {
  const Material m = ReadMaterial(Write(Fabric("0.2", kStretching, kBending)));
  EXPECT_EQ(m.name, "fabric-one");
  EXPECT_EQ(m.density, 0.2);
  const auto& stretch = std::get<MeasuredStretch>(m.stretch).table;
  EXPECT_EQ(stretch[0][0], 1.0);
  EXPECT_EQ(stretch[4][1], -18.0);
  EXPECT_EQ(stretch[5][3], 24.0);
  const auto& bending = std::get<MeasuredBending>(m.bending).table;
  EXPECT_EQ(bending[1][4], 1e-5);
}

TEST(ReadMaterial, NamesWhatIsWrong) {
  EXPECT_EQ(ErrorOf("{\"density\": 0.2, \"stretc"), "not JSON from byte 25 on");
  EXPECT_EQ(ErrorOf("{\"density\": 1e999}"),
            "holds a number too large for 64 bits");
  EXPECT_EQ(ErrorOf("[1, 2]"),
            "expected a JSON object with density, stretching and bending");
  EXPECT_EQ(ErrorOf("{\"density\": 0.2}"), "stretching: missing");
  EXPECT_EQ(ErrorOf(Fabric("\"light\"", kStretching, kBending)),
            "density: expected a number");
  EXPECT_EQ(ErrorOf(Fabric("-0.2", kStretching, kBending)),
            "density is -0.2, expected a positive number of kg/m^2");
  EXPECT_EQ(ErrorOf(Fabric("0.2", "[[1,2,3,4]]", kBending)),
            "stretching: expected 6 rows of 4 numbers, found 1 rows");
  EXPECT_EQ(
      ErrorOf(Fabric("0.2", kStretching, "[[1,2,3,4,5],[1,2,3],[1,2,3,4,5]]")),
      "bending[1]: expected 3 rows of 5 numbers");
  EXPECT_EQ(
      ErrorOf(Fabric(
          "0.2", kStretching, "[[1,2,3,4,5],[1,2,null,4,5],[1,2,3,4,5]]")),
      "bending[1][2]: expected a number");
  // Newton-millimetres, say.
  EXPECT_EQ(ErrorOf(Fabric(
                "0.2", kStretching, "[[1,2,3,4,5],[1,2,3,4,5],[1,2,3,4,5]]")),
            "bending[0][0] is 1, expected a number of N m below 1");
  EXPECT_THROW(ReadMaterial(testing::TempDir() + "no-such.json"), InputError);
}

}  // namespace
}  // namespace invsim
