// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/body_sequence.h"

#include <algorithm>
#include <cmath>

#include "invsim/body/rotation.h"

namespace invsim {
namespace {

// Weights g_1 .. g_r of a window of `r` frames either side; g_0 makes the sum
// with both sides one.
std::vector<double> Window(double sigma, int r) {
  std::vector<double> g(r + 1);
  double sum = 0;
  for (int k = 0; k <= r; ++k) {
    g[k] = std::exp(-0.5 * (k / sigma) * (k / sigma));
    sum += k == 0 ? g[k] : 2 * g[k];
  }
  for (double& value : g) value /= sum;
  return g;
}

}  // namespace

void Canonicalize(PoseVector* pose) {
  for (int j = 0; j < kNumJoints; ++j)
    pose->segment<3>(3 * j) = Log(Exp(pose->segment<3>(3 * j)));
}

BodySequence GaussianFilter(const BodySequence& sequence, double sigma) {
  BodySequence result = sequence;
  const int n = sequence.num_frames();
  if (sigma > 0) {
    const int reach = static_cast<int>(std::ceil(3 * sigma));
    for (int t = 0; t < n; ++t) {
      const int r = std::min({reach, t, n - 1 - t});
      const std::vector<double> g = Window(sigma, r);
      for (int j = 0; j < kNumJoints; ++j) {
        const Matrix3d here = Exp(sequence.poses[t].segment<3>(3 * j));
        Vector3d mean = Vector3d::Zero();
        for (int k = 1; k <= r; ++k) {
          for (const int s : {t - k, t + k}) {
            const Matrix3d there = Exp(sequence.poses[s].segment<3>(3 * j));
            mean += g[k] * Log(here.transpose() * there);
          }
        }
        result.poses[t].segment<3>(3 * j) = Log(here * Exp(mean));
      }
      Vector3d shift = Vector3d::Zero();
      for (int k = 1; k <= r; ++k)
        for (const int s : {t - k, t + k})
          shift += g[k] * (sequence.translations[s] - sequence.translations[t]);
      result.translations[t] += shift;
    }
  }
  return result;
}

}  // namespace invsim
