// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/cloth_difference.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "invsim/base/error.h"
#include "invsim/io/ply.h"
#include "invsim/io/point_sequence.h"

namespace invsim {
namespace {

constexpr double kMillimetres = 1000;

PointSequence Frames(const std::string& run) {
  return ScanPointSequence((std::filesystem::path(run) / "cloth").string());
}

}  // namespace

double ClothDifference::total_rms_mm() const {
  double sum = 0;
  for (const double r : rms_mm) sum += r * r;
  return std::sqrt(sum / static_cast<double>(rms_mm.size()));
}

ClothDifference CompareClothFolders(const std::string& run,
                                    const std::string& reference) {
  const PointSequence a = Frames(run), b = Frames(reference);
  if (a.files.size() != b.files.size())
    throw InputError(run + ": " + std::to_string(a.files.size()) +
                     " frames of cloth, expected " +
                     std::to_string(b.files.size()) + " as in " + reference);
  ClothDifference d;
  double sum = 0;
  for (size_t t = 0; t < a.files.size(); ++t) {
    const Points x = ReadPly(a.files[t]).vertices;
    const Points y = ReadPly(b.files[t]).vertices;
    if (x.cols() != y.cols())
      throw InputError(a.files[t] + ": " + std::to_string(x.cols()) +
                       " vertices, expected " + std::to_string(y.cols()) +
                       " as in " + b.files[t]);
    const VectorXd distance = kMillimetres * (x - y).colwise().norm();
    d.rms_mm.push_back(std::sqrt(distance.squaredNorm() /
                                 static_cast<double>(distance.size())));
    sum += distance.mean();
    d.max_mm = std::max(d.max_mm, distance.maxCoeff());
  }
  d.mean_mm = sum / static_cast<double>(a.files.size());
  return d;
}

}  // namespace invsim
