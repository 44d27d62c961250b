// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/glb.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "invsim/base/error.h"

namespace invsim {
namespace {

using ::testing::ElementsAre;

// A GLB taken apart by hand, as its specification describes it.
struct Glb {
  explicit Glb(const std::string& bytes) {
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(Word(bytes, 4), 2);
    EXPECT_EQ(Word(bytes, 8), bytes.size());
    const std::size_t json_size = Word(bytes, 12);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    json = nlohmann::json::parse(bytes.substr(20, json_size));
    const std::size_t at = 20 + json_size;
    EXPECT_EQ(at % 4, 0);
    EXPECT_EQ(bytes.substr(at + 4, 4), std::string("BIN\0", 4));
    data = bytes.substr(at + 8);
    EXPECT_EQ(Word(bytes, at), data.size());
  }

  static std::uint32_t Word(const std::string& bytes, std::size_t at) {
    std::uint32_t word;
    std::memcpy(&word, bytes.data() + at, sizeof(word));
    return word;
  }

  template <typename Number>
  std::vector<Number> Numbers(const nlohmann::json& accessor_number) const {
    const auto& accessor = json["accessors"].at(accessor_number.get<int>());
    const auto& view =
        json["bufferViews"].at(accessor["bufferView"].get<int>());
    const std::size_t offset = view.value("byteOffset", 0);
    const std::size_t length = view["byteLength"];
    EXPECT_EQ(offset % 4, 0);
    std::vector<Number> numbers(length / sizeof(Number));
    std::memcpy(numbers.data(), &data[offset], length);
    const std::size_t per_element = accessor["type"] == "VEC3" ? 3 : 1;
    EXPECT_EQ(accessor["count"].get<std::size_t>() * per_element,
              numbers.size());
    return numbers;
  }

  nlohmann::json json;
  std::string data;
};

GlbMesh Triangle(int num_frames) {
  GlbMesh mesh;
  mesh.name = "cloth";
  mesh.faces = Faces(3, 1);
  mesh.faces << 0, 1, 2;
  for (int t = 0; t < num_frames; ++t) {
    Points frame(3, 3);
    frame << 0, 1, 0, 0, 0, 1, t, t, 0.5 * t * t;
    mesh.frames.push_back(frame);
  }
  return mesh;
}

TEST(GlbTest, TargetsAndWeightsGiveTheFramesBack) {
  const GlbMesh mesh = Triangle(4);
  const Glb glb(FormatGlb({mesh}, {.frames_per_second = 10}));
  const auto& primitive = glb.json["meshes"][0]["primitives"][0];
  EXPECT_THAT(glb.Numbers<std::uint32_t>(primitive["indices"]),
              ElementsAre(0, 1, 2));
  const auto base = glb.Numbers<float>(primitive["attributes"]["POSITION"]);
  ASSERT_EQ(primitive["targets"].size(), 3);
  const auto& animation = glb.json["animations"][0];
  const auto& channel = animation["channels"][0];
  EXPECT_EQ(channel["target"]["path"], "weights");
  EXPECT_EQ(channel["target"]["node"], 0);
  const auto& sampler = animation["samplers"][0];
  EXPECT_THAT(glb.Numbers<float>(sampler["input"]),
              ElementsAre(0.0f, 0.1f, 0.2f, 0.3f));
  const auto weights = glb.Numbers<float>(sampler["output"]);
  ASSERT_EQ(weights.size(), 12);
  for (int t = 0; t < 4; ++t) {
    for (int i = 0; i < 9; ++i) {
      float value = base[i];
      for (int p = 0; p < 3; ++p) {
        value += weights[3 * t + p] *
                 glb.Numbers<float>(primitive["targets"][p]["POSITION"])[i];
      }
      EXPECT_EQ(value, static_cast<float>(mesh.frames[t].data()[i]));
    }
  }
}

TEST(GlbTest, StatesTheRangesViewersAskFor) {
  const Glb glb(FormatGlb({Triangle(2)}));
  const auto& primitive = glb.json["meshes"][0]["primitives"][0];
  const int base = primitive["attributes"]["POSITION"];
  EXPECT_THAT(glb.json["accessors"][base]["max"], ElementsAre(1, 1, 0));
  const int target = primitive["targets"][0]["POSITION"];
  EXPECT_THAT(glb.json["accessors"][target]["max"], ElementsAre(0, 0, 1));
  EXPECT_THAT(glb.json["accessors"][target]["min"], ElementsAre(0, 0, 0.5));
  EXPECT_EQ(glb.json["asset"]["version"], "2.0");
  EXPECT_THAT(glb.json["scenes"][0]["nodes"], ElementsAre(0));
}

TEST(GlbTest, HoldsSeveralMeshesOneOfThemAtRest) {
  GlbMesh body = Triangle(1);
  body.name = "body";
  body.color = {0.8, 0.6, 0.5};
  const Glb glb(FormatGlb({body, Triangle(3)}));
  ASSERT_EQ(glb.json["meshes"].size(), 2);
  EXPECT_EQ(glb.json["nodes"][1]["name"], "cloth");
  EXPECT_FALSE(glb.json["meshes"][0]["primitives"][0].contains("targets"));
  ASSERT_EQ(glb.json["animations"][0]["channels"].size(), 1);
  EXPECT_EQ(glb.json["animations"][0]["channels"][0]["target"]["node"], 1);
  EXPECT_THAT(
      glb.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"],
      ElementsAre(0.8, 0.6, 0.5, 1.0));
}

TEST(GlbTest, KeepsEvenlySpacedPosesOfALongSequence) {
  EXPECT_THAT(GlbPoses(1, 60), ElementsAre(0));
  EXPECT_THAT(GlbPoses(4, 60), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(GlbPoses(10, 4), ElementsAre(0, 3, 6, 9));
  EXPECT_THAT(GlbPoses(100, 3), ElementsAre(0, 50, 99));
  EXPECT_THAT(GlbPoses(100, 1), ElementsAre(0));
  const Glb glb(FormatGlb({Triangle(10)}, {.most_poses = 4}));
  const auto& sampler = glb.json["animations"][0]["samplers"][0];
  EXPECT_THAT(glb.Numbers<float>(sampler["input"]),
              ElementsAre(0.0f, 0.1f, 0.2f, 0.3f));
}

TEST(GlbTest, RefusesArraysThatDoNotFit) {
  GlbMesh mesh = Triangle(2);
  mesh.frames[1].resize(3, 2);
  EXPECT_THROW(FormatGlb({mesh}), Error);
  mesh = Triangle(2);
  mesh.frames[1](0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(FormatGlb({mesh}), Error);
  mesh = Triangle(2);
  mesh.faces(0, 0) = 3;
  EXPECT_THROW(FormatGlb({mesh}), Error);
  mesh.frames.clear();
  EXPECT_THROW(FormatGlb({mesh}), Error);
  EXPECT_THROW(WriteGlb("/nowhere/a.glb", {Triangle(1)}), InputError);
}

}  // namespace
}  // namespace invsim
