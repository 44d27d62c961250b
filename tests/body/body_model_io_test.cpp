// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <filesystem>

#include "invsim/base/error.h"
#include "invsim/body/body_model.h"
#include "invsim/io/npz.h"
#include "test_bodies.h"

namespace invsim {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr int kCount = 30;

std::vector<double> Values(const VertexRows& m) {
  return {m.data(), m.data() + m.size()};
}

class BodyModelIo : public ::testing::Test {
 protected:
  BodyModelIo()
      : path_(::testing::TempDir() + "/body_model_io_test.npz"),
        rng_(1),
        data_(RandomBodyData(kCount, true, &rng_)) {}
  ~BodyModelIo() override { std::filesystem::remove(path_); }

  // The arrays of a good file, to be spoilt and written.
  NpzArrays Arrays() {
    std::vector<std::uint32_t> kintree;
    for (const int p : data_.parents) kintree.push_back(p);
    for (int j = 0; j < kNumJoints; ++j) kintree.push_back(j);
    std::vector<std::uint32_t> f(data_.faces.data(),
                                 data_.faces.data() + data_.faces.size());
    return {
        {"v_template",
         NpyArray::Doubles({kCount, 3}, Values(data_.v_template.transpose()))},
        {"shapedirs",
         NpyArray::Doubles({kCount, 3, 10}, Values(data_.shapedirs))},
        {"J_regressor",
         NpyArray::Doubles({24, kCount}, Values(data_.joint_regressor))},
        {"weights", NpyArray::Doubles({kCount, 24}, Values(data_.weights))},
        {"kintree_table", NpyArray::Uints({2, 24}, kintree)},
        {"f", NpyArray::Uints({kCount - 2, 3}, f)}};
  }
  void Write(const std::string& name, const NpyArray& array) {
    NpzArrays arrays = Arrays();
    for (auto& [key, value] : arrays) {
      if (key == name) value = array;
    }
    WriteNpz(path_, arrays);
  }
  void ExpectError(const std::string& message) {
    EXPECT_THAT(
        [&] { ReadBodyModel(path_); },
        ThrowsMessage<InputError>(AllOf(HasSubstr(path_), HasSubstr(message))));
  }

  std::string path_;
  std::mt19937 rng_;
  BodyModelData data_;
};

TEST_F(BodyModelIo, WrittenBodyReadsBackTo32Bits) {
  const BodyModel written(data_);
  WriteBodyModel(path_, written);
  const BodyModel read = ReadBodyModel(path_);
  const BodyParameters p = RandomParameters(0.5, &rng_);
  EXPECT_EQ(read.faces(), written.faces());
  EXPECT_EQ(read.data().parents, written.data().parents);
  EXPECT_LT((read.Vertices(p) - written.Vertices(p)).cwiseAbs().maxCoeff(),
            1e-5);
  EXPECT_EQ(ReadNpz(path_).Array("joint_names").ToStrings("")[15], "head");
}

TEST_F(BodyModelIo, MissingPoseDirectionsAreZeros) {
  WriteNpz(path_, Arrays());
  data_.posedirs.resize(0, 0);
  const BodyParameters p = RandomParameters(0.5, &rng_);
  EXPECT_LT(
      (ReadBodyModel(path_).Vertices(p) - BodyModel(data_).Vertices(p)).norm(),
      1e-13);
}

TEST_F(BodyModelIo, FirstTenOfManyShapeDirectionsAreUsed) {
  VertexRows many = RandomMatrix(3 * kCount, 300, 1.0, &rng_);
  many.leftCols<10>() = data_.shapedirs;
  Write("shapedirs", NpyArray::Doubles({kCount, 3, 300}, Values(many)));
  EXPECT_EQ(ReadBodyModel(path_).data().shapedirs, data_.shapedirs);
}

TEST_F(BodyModelIo, UnsignedAndSignedRootsAreRead) {
  WriteNpz(path_, Arrays());
  EXPECT_EQ(ReadBodyModel(path_).data().parents[0], -1);
  std::vector<std::int64_t> kintree(data_.parents.begin(), data_.parents.end());
  for (int j = 0; j < kNumJoints; ++j) kintree.push_back(j);
  Write("kintree_table", NpyArray::Longs({2, 24}, kintree));
  EXPECT_EQ(ReadBodyModel(path_).data().parents[0], -1);
}

TEST_F(BodyModelIo, WrongArraysAreNamed) {
  Write("shapedirs",
        NpyArray::Doubles({kCount, 3, 5}, std::vector<double>(15 * kCount)));
  ExpectError("shapedirs has 5 directions: expected at least 10");
  Write("v_template", NpyArray::Doubles({3}, {1, 2, 3}));
  ExpectError("v_template is f8 (3,): expected shape (N, 3)");
  Write("weights", NpyArray::Doubles({1, 24}, std::vector<double>(24)));
  ExpectError("weights is f8 (1, 24): expected shape (30, 24)");
  Write("kintree_table",
        NpyArray::Uints({2, 52}, std::vector<std::uint32_t>(104)));
  ExpectError("kintree_table");
  Write("f", NpyArray::Uints({1, 3}, {0, 1, 30}));
  ExpectError("f: face 0 names vertex 30: expected 0 to 29");
  Write("f", NpyArray::Ulongs({1, 3}, {0, 1, std::uint64_t{1} << 40}));
  ExpectError("f: face 0 names vertex 1099511627776");
  Write("f", NpyArray::Doubles({1, 3}, {0, 1, 2}));
  ExpectError("f is f8 (1, 3): expected whole numbers");
}

TEST_F(BodyModelIo, MissingArraysAndFilesAreNamed) {
  WriteNpz(path_, {{"poses", NpyArray::Doubles({}, {0})}});
  ExpectError("has no array kintree_table (it has: poses)");
  std::filesystem::remove(path_);
  ExpectError("");
}

}  // namespace
}  // namespace invsim
