// SPDX-License-Identifier: Apache-2.0
#include "invsim/base/error.h"
#include "invsim/body/body_model.h"
#include "invsim/io/file.h"
#include "invsim/io/npz.h"

namespace invsim {

const std::array<const char*, kNumJoints> kJointNames = {
    "pelvis",        "left_hip",       "right_hip",    "spine1",
    "left_knee",     "right_knee",     "spine2",       "left_ankle",
    "right_ankle",   "spine3",         "left_foot",    "right_foot",
    "neck",          "left_collar",    "right_collar", "head",
    "left_shoulder", "right_shoulder", "left_elbow",   "right_elbow",
    "left_wrist",    "right_wrist",    "left_hand",    "right_hand"};

namespace {

using RowMajor = VertexRows;

RowMajor Matrix(const std::vector<double>& values,
                Eigen::Index rows,
                Eigen::Index cols) {
  return Eigen::Map<const RowMajor>(values.data(), rows, cols);
}

std::vector<double> Values(const RowMajor& m) {
  return {m.data(), m.data() + m.size()};
}

// The first ten of the directions, which are ordered by variance.
VertexRows ReadShapeDirections(const Npz& npz, Eigen::Index n) {
  const std::vector<double> all = npz.Doubles("shapedirs", {n, 3, -1});
  const auto count = static_cast<Eigen::Index>(all.size()) / (3 * n);
  if (count < kNumShape) {
    throw InputError(npz.name() + ": shapedirs has " + std::to_string(count) +
                     " directions: expected at least 10");
  }
  return Matrix(all, 3 * n, count).leftCols<kNumShape>();
}

std::vector<int> ReadParents(const Npz& npz) {
  const std::vector<std::int64_t> table =
      npz.Integers("kintree_table", {2, -1});
  const std::size_t count = table.size() / 2;
  std::vector<int> parents(count);
  for (std::size_t j = 0; j < count; ++j) {
    if (table[count + j] != static_cast<std::int64_t>(j)) {
      throw InputError(npz.name() + ": kintree_table numbers joint " +
                       std::to_string(j) + " as " +
                       std::to_string(table[count + j]) +
                       ": expected joints in order");
    }
    // The root's parent is -1, in unsigned files 2^32 - 1.
    const std::int64_t parent = table[j] == 0xffffffff ? -1 : table[j];
    parents[j] = parent < -1 || parent > kNumJoints ? kNumJoints
                                                    : static_cast<int>(parent);
  }
  return parents;
}

Faces ReadFaces(const Npz& npz, Eigen::Index num_vertices) {
  const std::vector<std::int64_t> values = npz.Integers("f", {-1, 3});
  Faces faces(3, values.size() / 3);
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (values[k] < 0 || values[k] >= num_vertices) {
      throw InputError(npz.name() + ": f: face " + std::to_string(k / 3) +
                       " names vertex " + std::to_string(values[k]) +
                       ": expected 0 to " + std::to_string(num_vertices - 1));
    }
    faces.data()[k] = static_cast<int>(values[k]);
  }
  return faces;
}

}  // namespace

BodyModel ReadBodyModel(const std::string& path) {
  return ParseBodyModel(ReadFileBytes(path), path);
}

BodyModel ParseBodyModel(std::string bytes, const std::string& path) {
  const Npz npz = Npz::Parse(std::move(bytes), path);
  BodyModelData data;
  data.parents = ReadParents(npz);
  if (data.parents.size() != kNumJoints) {
    throw InputError(path + ": kintree_table has " +
                     std::to_string(data.parents.size()) +
                     " joints: expected the 24 of SMPL");
  }
  const std::vector<double> v = npz.Doubles("v_template", {-1, 3});
  data.v_template = Matrix(v, v.size() / 3, 3).transpose();
  const Eigen::Index n = data.v_template.cols();
  if (n == 0) throw InputError(path + ": v_template is empty");
  data.shapedirs = ReadShapeDirections(npz, n);
  if (npz.Has("posedirs")) {
    data.posedirs = Matrix(npz.Doubles("posedirs", {n, 3, kNumPoseFeatures}),
                           3 * n,
                           kNumPoseFeatures);
  }
  data.joint_regressor =
      Matrix(npz.Doubles("J_regressor", {kNumJoints, n}), kNumJoints, n);
  data.weights = Matrix(npz.Doubles("weights", {n, kNumJoints}), n, kNumJoints);
  data.faces = ReadFaces(npz, n);
  return BodyModel(std::move(data), path);
}

std::string FormatBodyModel(const BodyModel& body) {
  const BodyModelData& data = body.data();
  const std::int64_t n = body.num_vertices();
  std::vector<std::uint32_t> kintree(2 * kNumJoints);
  std::vector<std::string> names;
  for (int j = 0; j < kNumJoints; ++j) {
    kintree[j] = static_cast<std::uint32_t>(data.parents[j]);
    kintree[kNumJoints + j] = static_cast<std::uint32_t>(j);
    names.emplace_back(kJointNames[j]);
  }
  const int* const f = data.faces.data();
  NpzArrays arrays = {
      {"v_template",
       NpyArray::Floats({n, 3}, Values(data.v_template.transpose()))},
      {"shapedirs",
       NpyArray::Floats({n, 3, kNumShape}, Values(data.shapedirs))},
      {"J_regressor",
       NpyArray::Floats({kNumJoints, n}, Values(data.joint_regressor))},
      {"weights", NpyArray::Floats({n, kNumJoints}, Values(data.weights))},
      {"kintree_table", NpyArray::Uints({2, kNumJoints}, kintree)},
      {"f",
       NpyArray::Uints({data.faces.cols(), 3}, {f, f + data.faces.size()})},
      {"joint_names", NpyArray::Text({kNumJoints}, names)}};
  if (data.posedirs.size() > 0) {
    arrays.emplace_back(
        "posedirs",
        NpyArray::Floats({n, 3, kNumPoseFeatures}, Values(data.posedirs)));
  }
  return FormatNpz(arrays);
}

void WriteBodyModel(const std::string& path, const BodyModel& body) {
  WriteFileBytes(path, FormatBodyModel(body));
}

}  // namespace invsim
