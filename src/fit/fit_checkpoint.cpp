// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/fit_checkpoint.h"

#include <filesystem>

#include "invsim/base/error.h"
#include "invsim/body/motion.h"
#include "invsim/io/npz.h"

namespace invsim {
namespace {

constexpr char kStart[] = "/start.npz";

NpyArray Rows(const Points& points) {
  return NpyArray::Doubles({points.cols(), 3},
                           {points.data(), points.data() + points.size()});
}

Points FromRows(const Npz& npz, const std::string& name, int count) {
  const std::vector<double> values = npz.Doubles(name, {count, 3});
  return Eigen::Map<const Points>(values.data(), 3, count);
}

}  // namespace

std::string FitCheckpoint::Evaluations(int dressing) const {
  return folder_ + "/evaluations_" + std::to_string(dressing) + ".bin";
}

std::string FitCheckpoint::Reference(int dressing) const {
  return folder_ + "/reference_" + std::to_string(dressing) + ".npz";
}

std::optional<BodySequence> FitCheckpoint::LoadStart(int num_frames) const {
  const std::string path = folder_ + kStart;
  if (!kept() || !std::filesystem::exists(path)) return std::nullopt;
  const Motion motion = ReadMotion(path);
  if (motion.num_frames() != num_frames)
    throw InputError(path + ": has " + std::to_string(motion.num_frames()) +
                     " frames, expected " + std::to_string(num_frames));
  return BodySequence{motion.shape, motion.poses, motion.translations};
}

std::optional<ClothReference> FitCheckpoint::LoadReference(
    int dressing, const Points& body, int cloth_vertices) const {
  const std::string path = Reference(dressing);
  if (!kept() || !std::filesystem::exists(path)) return std::nullopt;
  const Npz npz = ReadNpz(path);
  const ClothReference kept{
      FromRows(npz, "body", static_cast<int>(body.cols())),
      {FromRows(npz, "x", cloth_vertices), FromRows(npz, "v", cloth_vertices)}};
  return kept.body == body ? std::optional(kept) : std::nullopt;
}

void FitCheckpoint::Save(const BodySequence& start) const {
  if (!kept()) return;
  Motion motion;
  motion.shape = start.shape;
  motion.poses = start.poses;
  motion.translations = start.translations;
  WriteMotion(folder_ + kStart, motion);
}

void FitCheckpoint::Save(int dressing, const ClothReference& reference) const {
  if (!kept()) return;
  std::filesystem::remove(Evaluations(dressing));
  WriteNpz(Reference(dressing),
           {{"body", Rows(reference.body)},
            {"x", Rows(reference.cloth.x)},
            {"v", Rows(reference.cloth.v)}});
}

}  // namespace invsim
