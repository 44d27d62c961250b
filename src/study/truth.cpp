// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/truth.h"

#include <algorithm>
#include <cmath>

#include "invsim/base/error.h"
#include "invsim/io/npz.h"

namespace invsim {
namespace {

constexpr char kCloth[] = "cloth";
constexpr char kVelocities[] = "cloth_velocities";

// (T,N,3), one frame after the other.
NpyArray Pack(const std::vector<Points>& frames) {
  std::vector<double> values;
  for (const Points& p : frames)
    values.insert(values.end(), p.data(), p.data() + p.size());
  return NpyArray::Floats(
      {static_cast<std::int64_t>(frames.size()), frames[0].cols(), 3}, values);
}

std::vector<Points> Unpack(const Npz& npz, const std::string& name, int count) {
  std::vector<Points> frames;
  if (!npz.Has(name)) return frames;
  const std::vector<double> values = npz.Doubles(name, {count, -1, 3});
  if (!std::all_of(values.begin(), values.end(), [](double v) {
        return std::isfinite(v);
      }))
    throw InputError(npz.name() + ": " + name +
                     " holds a number that is not finite");
  const Eigen::Index size = static_cast<Eigen::Index>(values.size()) / count;
  for (int t = 0; t < count; ++t)
    frames.push_back(
        Eigen::Map<const Points>(values.data() + t * size, 3, size / 3));
  return frames;
}

}  // namespace

Truth ReadTruth(const std::string& path) {
  Truth truth;
  truth.body = ReadMotion(path);
  const Npz npz = ReadNpz(path);
  const int frames = truth.body.num_frames();
  truth.cloth = Unpack(npz, kCloth, frames);
  truth.cloth_velocities = Unpack(npz, kVelocities, frames);
  return truth;
}

void WriteTruth(const std::string& path, const Truth& truth) {
  NpzArrays arrays = MotionArrays(truth.body);
  if (!truth.cloth.empty()) arrays.push_back({kCloth, Pack(truth.cloth)});
  if (!truth.cloth_velocities.empty())
    arrays.push_back({kVelocities, Pack(truth.cloth_velocities)});
  WriteNpz(path, arrays);
}

}  // namespace invsim
