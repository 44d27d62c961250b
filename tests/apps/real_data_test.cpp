// SPDX-License-Identifier: Apache-2.0

// Garments worn by people who move, on data that is no part of the project:
//
//   INVSIM_DATA=FOLDER ./run test -R RealData
//
// with FOLDER/bodies/adult_low.npz, FOLDER/garments/{tshirt,dress,pants}.obj
// and FOLDER/motions/{walk,jump,cmu_55_01}.npz. Left out without it.

#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>

#include "geometry/triangle_crossing.h"
#include "invsim/cloth/garment.h"
#include "invsim/io/pc2.h"
#include "run_command.h"

namespace invsim {
namespace {

class RealData : public testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("INVSIM_DATA");
    if (!folder) GTEST_SKIP() << "INVSIM_DATA names no folder";
    data_ = folder;
    out_ = (TestDirectory() / "run").string();
  }
  std::string GarmentFile(const std::string& name) const {
    return data_ + "/garments/" + name + ".obj";
  }
  // Two seconds of it; the report.
  nlohmann::json Wear(const std::string& garment,
                      const std::string& motion,
                      const std::string& more) {
    const CommandResult result = RunCommand(
        "simulate -q --threads 1 --frames 60 --body " + data_ +
        "/bodies/adult_low.npz --motion " + data_ + "/motions/" + motion +
        ".npz --garment " + GarmentFile(garment) + " --out " + out_ + more);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return nlohmann::json::parse(ReadFileBytes(out_ + "/report.json"));
  }

  std::string data_, out_;
};

class RealDataShirt : public RealData,
                      public testing::WithParamInterface<std::string> {};

TEST_P(RealDataShirt, IsWornWithEveryStepConverged) {
  const nlohmann::json report = Wear("tshirt", GetParam(), "");
  EXPECT_EQ(report["total"]["steps_missed"], 0);
  EXPECT_LT(report["total"]["penetration_max_mm"], 1);
  const PointCache cloth = ReadPc2(out_ + "/cloth.pc2");
  ASSERT_EQ(cloth.samples.size(), 60u);
  for (const Points& x : cloth.samples) EXPECT_TRUE(x.allFinite());
}

INSTANTIATE_TEST_SUITE_P(Motions,
                         RealDataShirt,
                         testing::Values("walk", "cmu_55_01"),
                         [](const auto& test) { return test.param; });

class RealDataLayers
    : public RealData,
      public testing::WithParamInterface<std::tuple<std::string, std::string>> {
};

TEST_P(RealDataLayers, DoNotCross) {
  const auto& [name, motion] = GetParam();
  const nlohmann::json report =
      Wear(name,
           motion,
           " --set 'scene.effects=[\"inertia\",\"gravity\",\"membrane\","
           "\"bending\",\"self_contact\"]'");
  EXPECT_EQ(report["total"]["steps_missed"], 0);
  const Garment garment = ReadGarment(GarmentFile(name));
  const PointCache cloth = ReadPc2(out_ + "/cloth.pc2");
  ASSERT_EQ(cloth.samples.size(), 60u);
  for (size_t t = 0; t < cloth.samples.size(); ++t)
    EXPECT_EQ(CountCrossings(cloth.samples[t], garment.faces), 0)
        << "frame " << t;
}

INSTANTIATE_TEST_SUITE_P(
    Garments,
    RealDataLayers,
    testing::Combine(testing::Values("dress", "pants"),
                     testing::Values("walk", "jump", "cmu_55_01")),
    [](const auto& test) {
      return std::get<0>(test.param) + "_" + std::get<1>(test.param);
    });

}  // namespace
}  // namespace invsim
