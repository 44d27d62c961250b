// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/fit_checkpoint.h"

#include <filesystem>
#include <sstream>

#include "invsim/base/error.h"
#include "invsim/body/motion.h"
#include "invsim/io/file.h"
#include "invsim/io/npz.h"
#include "invsim/io/text_scanner.h"

namespace invsim {
namespace {

constexpr char kStart[] = "/start.npz";
constexpr char kInputs[] = "/inputs.txt";

// A line each: the digest, a blank, the name.
std::string Text(const InputDigests& inputs) {
  std::string text;
  for (const auto& [name, digest] : inputs) text += digest + " " + name + "\n";
  return text;
}

InputDigests Parse(const std::string& text) {
  InputDigests inputs;
  std::istringstream lines(text);
  std::string digest, name;
  while (lines >> digest && std::getline(lines >> std::ws, name))
    inputs[name] = digest;
  return inputs;
}

// What only one has, or another one.
std::vector<std::string> Differences(const InputDigests& a,
                                     const InputDigests& b) {
  InputDigests all = a;
  all.insert(b.begin(), b.end());
  std::vector<std::string> names;
  for (const auto& [name, ignored] : all)
    if (!a.contains(name) || !b.contains(name) || a.at(name) != b.at(name))
      names.push_back(name);
  return names;
}

[[noreturn]] void RefuseToGoOn(const std::string& path,
                               const std::string& what) {
  throw InputError(path + ": " + what +
                   "; choose another folder, or --force to begin anew");
}

NpyArray Rows(const Points& points) {
  return NpyArray::Doubles({points.cols(), 3},
                           {points.data(), points.data() + points.size()});
}

Points FromRows(const Npz& npz, const std::string& name, int count) {
  const std::vector<double> values = npz.Doubles(name, {count, 3});
  Points points = Eigen::Map<const Points>(values.data(), 3, count);
  if (!points.allFinite())
    throw InputError(npz.name() + ": " + name + ": expected finite numbers");
  return points;
}

}  // namespace

std::string FitCheckpoint::Evaluations(int dressing) const {
  return folder_ + "/evaluations_" + std::to_string(dressing) + ".bin";
}

std::string FitCheckpoint::Reference(int dressing) const {
  return folder_ + "/reference_" + std::to_string(dressing) + ".npz";
}

bool FitCheckpoint::HasStart() const {
  return kept() && std::filesystem::exists(folder_ + kStart);
}

void FitCheckpoint::Open(const InputDigests& inputs) const {
  if (!kept()) return;
  const std::string path = folder_ + kInputs;
  if (!std::filesystem::exists(path)) {
    if (HasStart())
      RefuseToGoOn(path, "is missing, and what the fit was made from unknown");
    WriteFileBytes(path, Text(inputs));
    return;
  }
  const std::vector<std::string> others =
      Differences(Parse(ReadFileBytes(path)), inputs);
  if (others.empty()) return;
  std::string what = Printable(others[0]);
  if (others.size() > 1)
    what += " and " + std::to_string(others.size() - 1) + " more";
  RefuseToGoOn(path, what + " changed since the fit was begun");
}

std::optional<BodySequence> FitCheckpoint::LoadStart(int num_frames) const {
  const std::string path = folder_ + kStart;
  if (!HasStart()) return std::nullopt;
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
