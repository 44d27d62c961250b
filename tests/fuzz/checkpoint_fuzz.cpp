// SPDX-License-Identifier: Apache-2.0
#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "fuzz_target.h"
#include "invsim/fit/fit_checkpoint.h"
#include "invsim/fit/remembered_term.h"
#include "invsim/io/file.h"
#include "mend_records.h"
#include "mend_zip.h"

namespace invsim {
namespace {

namespace fs = std::filesystem;

constexpr int kBodyVertices = 4, kClothVertices = 3;  // as in the corpus

// A folder of this process, which goes with it.
class Folder {
 public:
  Folder() {
    path_ = fs::temp_directory_path() / "invsim-checkpoint-XXXXXX";
    Require(mkdtemp(path_.data()) != nullptr, "there is a folder for files");
  }
  ~Folder() { fs::remove_all(path_); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

// A term of one frame that costs what its shape says.
class Squares : public DataTerm {
 public:
  int num_frames() const override { return 1; }
  Evaluation Evaluate(const BodySequence& x,
                      double,
                      std::vector<double>* costs) override {
    *costs = {x.shape.squaredNorm()};
    return Evaluation::kDone;
  }
  bool Linearize(std::vector<FrameBlock>* blocks) override {
    blocks->resize(1);
    FrameBlock& block = blocks->front();
    block.residual = VectorXd::Zero(kNumBodyParameters);
    block.jacobian = MatrixXd::Zero(kNumBodyParameters, kNumBodyParameters);
    return true;
  }
};

BodySequence Still(double height) {
  BodySequence x;
  x.shape[0] = height;
  x.poses.resize(1, PoseVector::Zero());
  x.translations.resize(1, Vector3d::Zero());
  return x;
}

bool IsFinite(const ClothReference& reference) {
  return reference.body.allFinite() && reference.cloth.x.allFinite() &&
         reference.cloth.v.allFinite();
}

void ReadFolder(const std::string& folder) {
  const FitCheckpoint checkpoint(folder);
  const auto read = [&](const auto& parse) {
    return ReadOrRefuse(parse, ErrorKind::kInput, folder);
  };
  read([&] {
    checkpoint.Open({{"points", "1"}});
    return true;
  });
  if (const auto start = read([&] { return checkpoint.LoadStart(1); }))
    Require(*start && (*start)->num_frames() == 1, "as many frames");
  const auto reference = read([&] {
    return checkpoint.LoadReference(
        1, Points::Zero(3, kBodyVertices), kClothVertices);
  });
  if (reference && *reference)
    Require(IsFinite(**reference), "cloth that is kept is finite");
}

// What the file remembers is an answer or none, and what is added is there
// when the file is opened again.
void ReadEvaluations(const std::string& folder) {
  const std::string path = FitCheckpoint(folder).Evaluations(1);
  Squares squares;
  int known = 0;
  const bool opened =
      ReadOrRefuse(
          [&] {
            RememberedTerm term(&squares, path);
            std::vector<double> costs;
            std::vector<FrameBlock> blocks;
            for (const double height : {0.0, 1.0, 2.0}) {
              const Evaluation outcome =
                  term.Evaluate(Still(height), kNoLimit, &costs);
              Require(outcome != Evaluation::kStopped, "it is an answer");
              if (outcome != Evaluation::kDone) continue;
              Require(costs.size() == 1, "a cost for every frame");
              if (term.Linearize(&blocks))
                Require(blocks.size() == 1, "a block for every frame");
            }
            known = term.known();
            return true;
          },
          ErrorKind::kInput,
          folder)
          .has_value();
  if (!opened) return;
  RememberedTerm again(&squares, path);
  Require(again.known() == known, "what was written is there again");
}

// The same bytes as every file of a checkpoint.
void Read(std::string_view bytes) {
  static const Folder folder;
  const std::string& path = folder.path();
  for (const char* name :
       {"inputs.txt", "start.npz", "reference_1.npz", "evaluations_1.bin"})
    WriteFileBytes(path + "/" + name, bytes);
  ReadFolder(path);
  ReadEvaluations(path);
}

void Mend(std::string* bytes) {
  MendZip(bytes);
  MendRecords(bytes);
}

}  // namespace

const FuzzTarget kFuzzTarget = {Read, Mend};

}  // namespace invsim
