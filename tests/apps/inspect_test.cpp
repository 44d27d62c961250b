// SPDX-License-Identifier: Apache-2.0

// `invsim inspect` on one file of every kind.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "invsim/io/npz.h"
#include "invsim/io/obj.h"
#include "invsim/io/pc2.h"
#include "invsim/io/ply.h"
#include "run_command.h"

namespace invsim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

class InspectTest : public ::testing::Test {
 protected:
  void SetUp() override { directory_ = TestDirectory().string(); }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  std::string Path(const std::string& name) const {
    return directory_ + "/" + name;
  }
  // Expects the exit code that goes with `usable`.
  static nlohmann::json Inspect(const std::string& path) {
    const CommandResult result = RunCommand("inspect --json '" + path + "'");
    const auto json = nlohmann::json::parse(result.out, nullptr, false);
    EXPECT_FALSE(json.is_discarded()) << result.out << result.err;
    if (json.is_discarded()) return {};
    EXPECT_EQ(json["path"], path);
    EXPECT_EQ(result.exit_code, json["usable"] ? 0 : 3) << result.err;
    EXPECT_EQ(result.err.empty(), json["usable"].get<bool>());
    return json;
  }

  std::string directory_;
};

// The corners of a person's box, upright and in metres.
Points Person() {
  Points points(3, 4);
  points << -0.3, 0.3, 0.1, 0, 0, 0, 1.7, 0.9, -0.2, 0.2, 0, 0;
  return points;
}

// A square of cloth of two triangles, 20 cm wide.
ObjMesh Square() {
  ObjMesh mesh;
  mesh.vertices.resize(3, 4);
  mesh.vertices << 0, 0.2, 0.2, 0, 0, 0, 0.2, 0.2, 0, 0, 0, 0;
  mesh.faces = (Faces(3, 2) << 0, 0, 1, 2, 2, 3).finished();
  mesh.texture = mesh.vertices.topRows<2>();
  mesh.texture_faces = mesh.faces;
  return mesh;
}

NpzArrays MotionFile(int frames) {
  return {{"poses",
           NpyArray::Doubles({frames, 72}, std::vector<double>(72 * frames))},
          {"trans",
           NpyArray::Doubles({frames, 3}, std::vector<double>(3 * frames))},
          {"mocap_framerate", NpyArray::Doubles({}, {30})}};
}

TEST_F(InspectTest, PointCloud) {
  PlyMesh ply;
  ply.vertices = Person();
  ply.AddScalar("quality", VectorXd::Zero(4));
  WritePly(Path("p.ply"), ply);
  const auto json = Inspect(Path("p.ply"));
  EXPECT_EQ(json["kind"], "point cloud");
  EXPECT_EQ(json["facts"]["points"], 4);
  EXPECT_THAT(json["facts"]["box_max"], ElementsAre(0.3, 1.7, 0.2));
  EXPECT_EQ(json["facts"]["guessed_unit"], "m");
  EXPECT_EQ(json["facts"]["guessed_up"], "y");
  EXPECT_EQ(json["facts"]["height_m"], 1.7);
  EXPECT_THAT(json["facts"]["properties"], ElementsAre("quality"));
  EXPECT_THAT(json["warnings"], IsEmpty());
}

TEST_F(InspectTest, PointCloudOfAnotherUnitAndAxisWithHoles) {
  WriteFileBytes(Path("p.xyz"),
                 "-300 -200 0\n300 200 1700\nnan nan nan\n0 0 900\n");
  const auto json = Inspect(Path("p.xyz"));
  EXPECT_EQ(json["facts"]["points"], 3);
  EXPECT_EQ(json["facts"]["non_finite_points"], 1);
  EXPECT_EQ(json["facts"]["guessed_unit"], "mm");
  EXPECT_EQ(json["facts"]["guessed_up"], "z");
  EXPECT_THAT(json["warnings"],
              ElementsAre("1 points are not finite and must be dropped",
                          HasSubstr("looks like mm, not metres"),
                          "z looks like the up axis, not y"));
}

TEST_F(InspectTest, TextForPeople) {
  WriteFileBytes(Path("p.xyz"), "-0.3 0 -0.2\n0.3 1.7 0.2\n");
  const CommandResult result = RunCommand("inspect " + Path("p.xyz"));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out,
            Path("p.xyz") +
                ": point cloud\n  points: 2\n  box_min: -0.3 0 -0.2\n"
                "  box_max: 0.3 1.7 0.2\n  guessed_unit: m\n"
                "  guessed_up: y\n  height_m: 1.7\n  usable: yes\n");
}

TEST_F(InspectTest, Sequence) {
  for (int t = 0; t < 3; ++t) {
    PlyMesh ply;
    ply.vertices = Person().leftCols(2 + t % 2);
    WritePly(Path("00000" + std::to_string(t) + ".ply"), ply);
  }
  auto json = Inspect(directory_);
  EXPECT_EQ(json["kind"], "point cloud sequence");
  EXPECT_EQ(json["facts"]["frames"], 3);
  EXPECT_EQ(json["facts"]["fewest_points"], 2);
  EXPECT_EQ(json["facts"]["most_points"], 3);

  WriteFileBytes(Path("000001.ply"), "ply\nformat ascii 1.0\n");
  json = Inspect(directory_);
  EXPECT_EQ(json["usable"], false);
  EXPECT_THAT(json["problem"].get<std::string>(),
              StartsWith(Path("000001.ply") + ": 21 bytes"));

  std::filesystem::remove(Path("000001.ply"));
  WriteFileBytes(Path("000003.ply"), "x");
  const CommandResult gap = RunCommand("inspect " + directory_);
  EXPECT_EQ(gap.exit_code, 3);
  EXPECT_THAT(gap.err, HasSubstr("frame 1 is missing"));
}

TEST_F(InspectTest, Garment) {
  ObjMesh square = Square();
  WriteObj(Path("g.obj"), square);
  auto json = Inspect(Path("g.obj"));
  EXPECT_EQ(json["kind"], "garment");
  EXPECT_EQ(json["facts"]["vertices"], 4);
  EXPECT_EQ(json["facts"]["faces"], 2);
  EXPECT_EQ(json["facts"]["rest_shape"], "pattern (vt)");
  EXPECT_EQ(json["facts"]["openings"], 1);
  EXPECT_EQ(json["facts"]["pieces"], 1);
  EXPECT_EQ(json["facts"]["area_m2"], 0.04);
  EXPECT_EQ(json["facts"]["rest_area_m2"], 0.04);

  square.vertices *= 100;
  WriteObj(Path("g.obj"), square);
  json = Inspect(Path("g.obj"));
  EXPECT_EQ(json["usable"], false);
  EXPECT_EQ(json["facts"]["faces"], 2);
  EXPECT_THAT(json["problem"].get<std::string>(), StartsWith(Path("g.obj")));

  WriteFileBytes(Path("p.obj"), "v 0 0 0\nv 0 1.7 0\n");
  EXPECT_EQ(Inspect(Path("p.obj"))["kind"], "point cloud");
}

TEST_F(InspectTest, Motion) {
  WriteNpz(Path("m.npz"), MotionFile(60));
  auto json = Inspect(Path("m.npz"));
  EXPECT_EQ(json["kind"], "motion");
  EXPECT_EQ(json["facts"]["frames"], 60);
  EXPECT_EQ(json["facts"]["frames_per_second"], 30);
  EXPECT_EQ(json["facts"]["seconds"], 2);
  EXPECT_EQ(json["facts"]["guessed_up"], "y");
  EXPECT_THAT(json["warnings"], IsEmpty());

  // A quarter turn about x: the body's up axis is the world's z.
  std::vector<double> poses(72 * 2);
  poses[0] = poses[72] = M_PI / 2;
  NpzArrays z_up = MotionFile(2);
  z_up[0].second = NpyArray::Doubles({2, 72}, poses);
  WriteNpz(Path("m.npz"), z_up);
  json = Inspect(Path("m.npz"));
  EXPECT_EQ(json["facts"]["guessed_up"], "z");
  EXPECT_THAT(json["warnings"], ElementsAre(HasSubstr("z looks like")));

  NpzArrays arrays = MotionFile(60);
  arrays[1].second = NpyArray::Doubles({59, 3}, std::vector<double>(3 * 59));
  WriteNpz(Path("m.npz"), arrays);
  json = Inspect(Path("m.npz"));
  EXPECT_EQ(json["usable"], false);
  EXPECT_THAT(json["problem"].get<std::string>(), HasSubstr("trans"));
}

// A tetrahedron all of whose weight is on the root.
NpzArrays Body() {
  const std::vector<double> vertices = {0, 0, 0, 1, 0, 0, 0, 1.7, 0, 0, 0, 1};
  std::vector<double> weights(4 * 24);
  for (int v = 0; v < 4; ++v) weights[24 * v] = 1;
  std::vector<double> regressor(24 * 4);
  for (int j = 0; j < 24; ++j) regressor[4 * j] = 1;
  std::vector<std::int64_t> tree(2 * 24);
  for (int j = 0; j < 24; ++j) {
    tree[j] = j - 1;
    tree[24 + j] = j;
  }
  return {
      {"v_template", NpyArray::Doubles({4, 3}, vertices)},
      {"shapedirs", NpyArray::Doubles({4, 3, 10}, std::vector<double>(120))},
      {"J_regressor", NpyArray::Doubles({24, 4}, regressor)},
      {"weights", NpyArray::Doubles({4, 24}, weights)},
      {"kintree_table", NpyArray::Longs({2, 24}, tree)},
      {"f", NpyArray::Ints({4, 3}, {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3})}};
}

TEST_F(InspectTest, BodyModel) {
  WriteNpz(Path("b.npz"), Body());
  const auto json = Inspect(Path("b.npz"));
  EXPECT_EQ(json["kind"], "body model");
  EXPECT_EQ(json["facts"]["vertices"], 4);
  EXPECT_EQ(json["facts"]["faces"], 4);
  EXPECT_EQ(json["facts"]["joints"], 24);
  EXPECT_EQ(json["facts"]["pose_directions"], 0);
  EXPECT_EQ(json["facts"]["height_m"], 1.7);
}

TEST_F(InspectTest, PointCache) {
  WritePc2(Path("c.pc2"), {{Person(), Person(), Person()}});
  const auto json = Inspect(Path("c.pc2"));
  EXPECT_EQ(json["kind"], "point cache");
  EXPECT_EQ(json["facts"]["samples"], 3);
  EXPECT_EQ(json["facts"]["vertices"], 4);
}

TEST_F(InspectTest, Material) {
  std::string row = "[20, 10, 20, 8]";
  std::string rows = row;
  for (int i = 1; i < 6; ++i) rows += ", " + row;
  const std::string bend = "[1e-5, 1e-5, 1e-5, 1e-5, 1e-5]";
  WriteFileBytes(Path("cloth.json"),
                 "{\"density\": 0.15, \"stretching\": [" + rows +
                     "], \"bending\": [" + bend + ", " + bend + ", " + bend +
                     "]}");
  const auto json = Inspect(Path("cloth.json"));
  EXPECT_EQ(json["kind"], "cloth material");
  EXPECT_EQ(json["facts"]["density_kg_m2"], 0.15);
  EXPECT_EQ(json["facts"]["stretch"], "measured");
}

TEST_F(InspectTest, RunFolder) {
  std::filesystem::create_directory(Path("cloth"));
  WriteNpz(Path("body.npz"), MotionFile(2));
  PlyMesh ply;
  ply.vertices = Person();
  WritePly(Path("cloth/000000.ply"), ply);
  auto json = Inspect(directory_);
  EXPECT_EQ(json["kind"], "run folder");
  EXPECT_EQ(json["facts"]["frames"], 2);
  EXPECT_EQ(json["facts"]["cloth_files"], 1);
  EXPECT_EQ(json["facts"]["has_checkpoint"], false);
  EXPECT_THAT(json["warnings"], ElementsAre("1 files in cloth/ for 2 frames"));

  WriteNpz(Path("body.npz"), Body());
  json = Inspect(directory_);
  EXPECT_THAT(json["problem"].get<std::string>(),
              HasSubstr("is a body model: expected a motion"));
}

TEST_F(InspectTest, WhatItDoesNotKnow) {
  const auto refused = [&](const std::string& name,
                           const std::string& bytes,
                           const std::string& message) {
    WriteFileBytes(Path(name), bytes);
    const CommandResult result = RunCommand("inspect " + Path(name));
    EXPECT_EQ(result.exit_code, 3) << name;
    EXPECT_EQ(result.out, "") << name;
    EXPECT_THAT(result.err, HasSubstr(message)) << name;
  };
  refused("a.fbx", "x", "extension 'fbx': expected a directory or a file npz");
  refused("smpl.pkl", std::string("\x80\x02}q", 4), "pickle");
  refused("other.npz",
          FormatNpz({{"a", NpyArray::Doubles({1}, {0})}}),
          "arrays a: expected a body model");
}

}  // namespace
}  // namespace invsim
