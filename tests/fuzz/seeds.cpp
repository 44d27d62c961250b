// SPDX-License-Identifier: Apache-2.0
// Writes the binary files of the corpus, small and valid (or nearly), with the
// library's own writers:
//
//   fuzz_seeds tests/fuzz/corpus
//
// The text files beside them are written by hand; bug_* are inputs that broke a
// reader once, and are not made here.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>

#include "invsim/body/body_model.h"
#include "invsim/body/motion.h"
#include "invsim/fit/fit_checkpoint.h"
#include "invsim/fit/remembered_term.h"
#include "invsim/io/file.h"
#include "invsim/io/npz.h"
#include "invsim/io/pc2.h"
#include "invsim/io/ply.h"

namespace invsim {
namespace {

// Members as they are: a change of one byte is a change of one byte.
constexpr ZipOptions kStored = {.deflate = false};

template <typename T>
std::string Bytes(std::initializer_list<T> values) {
  return {reinterpret_cast<const char*>(values.begin()),
          values.size() * sizeof(T)};
}

// Each number of `size` bytes turned round.
std::string Swapped(std::string bytes, std::size_t size) {
  for (std::size_t i = 0; i + size <= bytes.size(); i += size) {
    std::reverse(bytes.begin() + i, bytes.begin() + i + size);
  }
  return bytes;
}

Points Corners() {
  Points corners(3, 4);
  corners << 0, 1, 1, 0,  //
      0, 0, 1, 1,         //
      0, 0, 0, 0.5;
  return corners;
}

Faces TwoFaces() {
  Faces faces(3, 2);
  faces << 0, 0,  //
      1, 2,       //
      2, 3;
  return faces;
}

void WritePlySeeds(const std::string& folder) {
  PlyMesh mesh;
  mesh.vertices = Corners();
  mesh.faces = TwoFaces();
  mesh.AddScalar("quality", VectorXd::LinSpaced(4, 0, 1));
  mesh.AddColors(Corners());
  WritePly(folder + "mesh", mesh);
  mesh.position_type = PlyType::kFloat64;
  mesh.faces.resize(3, 0);
  WritePly(folder + "points_double", mesh);
  WriteFileBytes(folder + "big_endian",
                 "ply\r\nformat binary_big_endian 1.0\r\ncomment a\r\n"
                 "element vertex 2\r\nproperty float x\r\nproperty float y\r\n"
                 "property float z\r\nproperty list uchar short seen\r\n"
                 "element camera 1\r\nproperty double f\r\nend_header\r\n" +
                     Swapped(Bytes({1.f, 2.f, 3.f}), 4) +
                     std::string("\1\0\7", 3) +
                     Swapped(Bytes({4.f, 5.f, 6.f}), 4) + std::string("\0", 1) +
                     Swapped(Bytes({35.0}), 8));
}

void WritePcdSeeds(const std::string& folder) {
  const std::string header =
      "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z _ rgb\nSIZE 4 4 4 1 4\n"
      "TYPE F F F U U\nCOUNT 1 1 1 4 1\nWIDTH 2\nHEIGHT 1\n"
      "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA ";
  const std::string row = Bytes({1.f, 2.f, 3.f}) + "____" + Bytes({255u});
  WriteFileBytes(folder + "binary", header + "binary\n" + row + row);
  // 32 bytes of blocks: 8 as they are, then 24 copied from 8 before.
  const std::string packed = "\7" + Bytes({1.f, 2.f}) + "\xe0\x0f\7";
  WriteFileBytes(folder + "compressed",
                 header + "binary_compressed\n" +
                     Bytes({static_cast<std::uint32_t>(packed.size()), 32u}) +
                     packed);
}

void WritePc2Seeds(const std::string& folder) {
  WritePc2(folder + "two_samples", {{Corners(), 2 * Corners()}, 1, 0.5});
  WritePc2(folder + "empty", {});
}

// An npy whose type and order our writer does not write.
std::string Npy(const std::string& descr,
                bool fortran_order,
                const std::string& shape,
                const std::string& data) {
  std::string text = "{'descr': '" + descr + "', 'fortran_order': " +
                     (fortran_order ? "True" : "False") + ", 'shape': (" +
                     shape + "), }";
  text.append(63 - (10 + text.size()) % 64, ' ');
  return std::string("\x93NUMPY\1\0", 8) + static_cast<char>(text.size() + 1) +
         '\0' + text + '\n' + data;
}

void WriteNpySeeds(const std::string& folder) {
  WriteNpy(folder + "doubles", NpyArray::Doubles({2, 2}, {0, 1, -2.5, 1e300}));
  WriteNpy(folder + "floats", NpyArray::Floats({3, 1}, {0, 1, -2.5}));
  WriteNpy(folder + "scalar", NpyArray::Longs({}, {-7}));
  WriteNpy(folder + "ulongs", NpyArray::Ulongs({1}, {~std::uint64_t{0}}));
  WriteNpy(folder + "bools", NpyArray::Bools({3}, {true, false, true}));
  WriteNpy(folder + "text", NpyArray::Text({2}, {"a", "\u00e9\u20ac"}));
  WriteNpy(folder + "empty", NpyArray::Uints({0, 3}, {}));
  WriteFileBytes(folder + "bytes",
                 Npy("|S3", false, "2,", std::string("ab\0\xff\0c", 6)));
  WriteFileBytes(
      folder + "halves",
      Npy("<f2", false, "2,", Bytes<std::uint16_t>({0x3c00, 0x7c01})));
  WriteFileBytes(
      folder + "big_endian",
      Npy(">i4", true, "2, 3", Swapped(Bytes({1, 2, 3, 4, 5, 6}), 4)));
}

void WriteNpzSeeds(const std::string& folder) {
  const NpzArrays arrays = {{"a", NpyArray::Doubles({2}, {1, 2})},
                            {"b", NpyArray::Text({}, {"text"})}};
  WriteNpz(folder + "stored", arrays, kStored);
  WriteNpz(folder + "deflated", arrays);
  WriteNpz(folder + "zip64", arrays, {.deflate = false, .always_zip64 = true});
  const NpyArray one = NpyArray::Bools({1}, {true});
  WriteNpz(folder + "escaping_names",
           {{"../escaped", one}, {"/tmp/escaped", one}, {"", one}},
           kStored);
  WriteFileBytes(folder + "not_an_array",
                 BuildZip({{"readme.txt", "no array"}, {"a.npy", "neither"}}));
}

void WritePointsSeeds(const std::string& folder) {
  const Points corners = Corners();
  WriteNpy(folder + "npy",
           NpyArray::Floats({4, 3},
                            {corners.data(), corners.data() + corners.size()}));
}

// The file of a body or a motion with its members stored.
std::string Stored(const std::string& bytes) {
  const Npz npz = Npz::Parse(bytes, "seed");
  NpzArrays arrays;
  for (const std::string& name : npz.Names()) {
    arrays.emplace_back(name, npz.Array(name));
  }
  return FormatNpz(arrays, kStored);
}

void WriteBodySeeds(const std::string& folder) {
  BodyModelData data;
  data.v_template = Corners();
  data.shapedirs = VertexRows::Constant(12, kNumShape, 0.01);
  data.joint_regressor = MatrixXd::Constant(kNumJoints, 4, 0.25);
  data.weights = MatrixXd::Zero(4, kNumJoints);
  for (int i = 0; i < 4; ++i) data.weights(i, 5 * i) = 1;
  for (int j = 0; j < kNumJoints; ++j) data.parents.push_back(j / 2 - (j == 0));
  data.faces = TwoFaces();
  WriteFileBytes(folder + "four_vertices",
                 Stored(FormatBodyModel(BodyModel(data))));
  data.posedirs = VertexRows::Constant(12, kNumPoseFeatures, 0.001);
  WriteFileBytes(folder + "with_posedirs", FormatBodyModel(BodyModel(data)));
}

void WriteMotionSeeds(const std::string& folder) {
  Motion motion;
  motion.poses.assign(2, PoseVector::Constant(0.1));
  motion.translations.assign(2, Vector3d(0, 1, 0));
  WriteFileBytes(folder + "two_frames",
                 FormatNpz(MotionArrays(motion), kStored));
  const std::vector<double> pose(156, 0.25);
  WriteNpz(folder + "smpl_h",
           {{"poses", NpyArray::Floats({1, 156}, pose)},
            {"trans", NpyArray::Floats({1, 3}, {0, 0, 0})},
            {"betas", NpyArray::Floats({2}, {1, -1})},
            {"mocap_framerate", NpyArray::Ints({}, {120})}},
           kStored);
}

// A term of one frame whose every number is 0.5.
class Halves : public DataTerm {
 public:
  int num_frames() const override { return 1; }
  Evaluation Evaluate(const BodySequence&,
                      double,
                      std::vector<double>* costs) override {
    *costs = {0.5};
    return Evaluation::kDone;
  }
  bool Linearize(std::vector<FrameBlock>* blocks) override {
    constexpr int n = kNumBodyParameters;
    blocks->assign(
        1, {0.5, VectorXd::Constant(n, 0.5), MatrixXd::Constant(n, n, 0.5)});
    return true;
  }
};

// Each file of a checkpoint under its own name, and inputs as one of them.
void WriteCheckpointSeeds(const std::string& folder) {
  const FitCheckpoint checkpoint(folder);
  checkpoint.Open({{"points", "1"}, {"the body", "2"}});
  BodySequence x;
  x.poses.assign(1, PoseVector::Zero());
  x.translations.assign(1, Vector3d::Zero());
  checkpoint.Save(x);
  checkpoint.Save(
      1, {Points::Zero(3, 4), {Points::Ones(3, 3), Points::Zero(3, 3)}});
  Halves halves;
  RememberedTerm term(&halves, checkpoint.Evaluations(1));
  std::vector<double> costs;
  std::vector<FrameBlock> blocks;
  term.Evaluate(x, kNoLimit, &costs);
  term.Linearize(&blocks);
  x.shape[0] = 1;
  term.Evaluate(x, kNoLimit, &costs);
  for (const char* name : {"start.npz", "reference_1.npz"})
    WriteFileBytes(folder + name, Stored(ReadFileBytes(folder + name)));
}

}  // namespace
}  // namespace invsim

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s CORPUS_DIRECTORY\n", *argv);
    return 2;
  }
  const std::string corpus = std::string(argv[1]) + "/";
  invsim::WritePlySeeds(corpus + "ply/");
  invsim::WritePcdSeeds(corpus + "pcd/");
  invsim::WritePc2Seeds(corpus + "pc2/");
  invsim::WriteNpySeeds(corpus + "npy/");
  invsim::WriteNpzSeeds(corpus + "npz/");
  invsim::WritePointsSeeds(corpus + "points/");
  invsim::WriteBodySeeds(corpus + "body/");
  invsim::WriteMotionSeeds(corpus + "motion/");
  invsim::WriteCheckpointSeeds(corpus + "checkpoint/");
}
