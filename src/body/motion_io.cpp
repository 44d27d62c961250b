// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "invsim/base/error.h"
#include "invsim/body/motion.h"
#include "invsim/io/file.h"
#include "invsim/io/npz.h"

namespace invsim {
namespace {

// Beyond it an angle has no direction left, and a place no millimetres.
constexpr double kLargest = 1e6;

constexpr int kBodyNumbers = 66;  // 22 joints, all that SMPL-H and SMPL-X share

void RequireFinite(const std::vector<double>& values, const std::string& what) {
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!std::isfinite(values[k])) {
      throw InputError(what + " holds " + std::to_string(values[k]) +
                       " (value " + std::to_string(k) +
                       "): expected finite numbers");
    }
  }
}

std::vector<double> FiniteDoubles(const Npz& npz,
                                  const std::string& array,
                                  const NpyArray::Shape& shape) {
  std::vector<double> values = npz.Doubles(array, shape);
  RequireFinite(values, npz.name() + ": " + array);
  return values;
}

double ReadFrameRate(const Npz& npz) {
  std::optional<double> rate;
  for (const char* name : {"mocap_framerate", "mocap_frame_rate"}) {
    if (!npz.Has(name)) continue;
    const std::string what = npz.name() + ": " + name;
    const NpyArray array = npz.Array(name);
    const std::vector<double> values = array.ToDoubles(what);
    if (values.size() != 1 || !(values[0] > 0.0) || !std::isfinite(values[0])) {
      throw InputError(what + " is " +
                       (values.size() == 1 ? std::to_string(values[0])
                                           : array.Description()) +
                       ": expected a positive number of frames per second");
    }
    if (rate && *rate != values[0]) {
      throw InputError(npz.name() + ": mocap_framerate is " +
                       std::to_string(*rate) + " but mocap_frame_rate is " +
                       std::to_string(values[0]) + ": expected one frame rate");
    }
    rate = values[0];
  }
  if (!rate) {
    throw InputError(npz.name() +
                     ": has neither mocap_framerate nor mocap_frame_rate: "
                     "expected the frames per second");
  }
  return *rate;
}

// Rows of numbers, one per frame, none of which is out of all proportion.
std::vector<double> FrameDoubles(const Npz& npz,
                                 const std::string& array,
                                 const NpyArray::Shape& shape,
                                 const std::string& unit) {
  std::vector<double> values = FiniteDoubles(npz, array, shape);
  const std::size_t width = npz.Array(array).shape()[1];
  for (std::size_t k = 0; k < values.size(); ++k)
    if (std::abs(values[k]) > kLargest) {
      std::ostringstream text;
      text << npz.name() << ": " << array << " of frame " << k / width
           << " holds " << values[k] << " (value " << k % width
           << "): expected at most " << kLargest << " " << unit;
      throw InputError(text.str());
    }
  return values;
}

ShapeVector ReadBetas(const Npz& npz) {
  ShapeVector shape = ShapeVector::Zero();
  if (!npz.Has("betas")) return shape;
  const std::vector<double> betas = FiniteDoubles(npz, "betas", {-1});
  const std::size_t count = std::min<std::size_t>(betas.size(), kNumShape);
  std::copy_n(betas.begin(), count, shape.data());
  return shape;
}

std::string ReadGender(const Npz& npz) {
  if (!npz.Has("gender")) return "neutral";
  const std::vector<std::string> gender =
      npz.Array("gender").ToStrings(npz.name() + ": gender");
  return gender.empty() ? "neutral" : gender[0];
}

void ReadPoses(const Npz& npz, Motion* motion) {
  const std::vector<double> values =
      FrameDoubles(npz, "poses", {-1, -1}, "rad");
  const NpyArray::Shape shape = npz.Array("poses").shape();
  const std::int64_t numbers = shape[1];
  if (numbers != kNumPose && numbers != 156 && numbers != 165) {
    throw InputError(npz.name() + ": poses has " + std::to_string(numbers) +
                     " numbers a frame: expected 72 (SMPL), 156 (SMPL-H) or "
                     "165 (SMPL-X)");
  }
  if (shape[0] == 0) throw InputError(npz.name() + ": poses has no frames");
  const std::int64_t used = numbers == kNumPose ? kNumPose : kBodyNumbers;
  motion->poses.assign(shape[0], PoseVector::Zero());
  for (std::int64_t t = 0; t < shape[0]; ++t) {
    std::copy_n(values.begin() + t * numbers, used, motion->poses[t].data());
  }
}

}  // namespace

Motion ReadMotion(const std::string& path) {
  return ParseMotion(ReadFileBytes(path), path);
}

Motion ParseMotion(std::string bytes, const std::string& path) {
  const Npz npz = Npz::Parse(std::move(bytes), path);
  Motion motion;
  motion.frame_rate = ReadFrameRate(npz);
  motion.shape = ReadBetas(npz);
  motion.gender = ReadGender(npz);
  ReadPoses(npz, &motion);
  const std::vector<double> trans =
      FrameDoubles(npz, "trans", {motion.num_frames(), 3}, "m");
  for (int t = 0; t < motion.num_frames(); ++t) {
    motion.translations.emplace_back(&trans[3 * t]);
  }
  return motion;
}

NpzArrays MotionArrays(const Motion& motion) {
  const std::int64_t frames = motion.num_frames();
  std::vector<double> poses;
  std::vector<double> trans;
  for (const PoseVector& pose : motion.poses) {
    poses.insert(poses.end(), pose.data(), pose.data() + kNumPose);
  }
  for (const Vector3d& t : motion.translations) {
    trans.insert(trans.end(), t.data(), t.data() + 3);
  }
  const double* const shape = motion.shape.data();
  const NpyArray rate = NpyArray::Doubles({}, {motion.frame_rate});
  return {{"poses", NpyArray::Doubles({frames, kNumPose}, poses)},
          {"trans", NpyArray::Doubles({frames, 3}, trans)},
          {"betas", NpyArray::Doubles({kNumShape}, {shape, shape + kNumShape})},
          {"gender", NpyArray::Text({}, {motion.gender})},
          {"mocap_framerate", rate},
          {"mocap_frame_rate", rate}};
}

void WriteMotion(const std::string& path, const Motion& motion) {
  WriteNpz(path, MotionArrays(motion));
}

}  // namespace invsim
