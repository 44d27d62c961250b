// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/point_cloud.h"

#include "invsim/base/error.h"
#include "invsim/base/names.h"
#include "invsim/io/file.h"
#include "invsim/io/npy.h"
#include "invsim/io/obj.h"
#include "invsim/io/pcd.h"
#include "invsim/io/ply.h"
#include "invsim/io/text_scanner.h"

namespace invsim {
namespace {

Points ParseXyz(std::string_view bytes, const std::string& name) {
  TextScanner scanner(bytes, name, '#');
  std::vector<double> numbers;
  while (scanner.NextLine()) {
    for (const char* axis : {"x", "y", "z"}) {
      numbers.push_back(scanner.ToNumber(scanner.Word(), axis));
    }
  }
  return Eigen::Map<const Points>(
      numbers.data(), 3, static_cast<Eigen::Index>(numbers.size() / 3));
}

Points ParseNpyPoints(std::string_view bytes, const std::string& name) {
  const NpyArray array = ParseNpy(bytes, name);
  if (array.shape().size() != 2 || array.shape()[1] != 3) {
    throw InputError(name + ": array " + array.Description() +
                     ": expected shape (N, 3)");
  }
  // Row by row is point by point: the memory of Points.
  const std::vector<double> numbers = array.ToDoubles(name);
  return Eigen::Map<const Points>(
      numbers.data(), 3, static_cast<Eigen::Index>(numbers.size() / 3));
}

Points ParseAnyPoints(std::string_view bytes,
                      const std::string& extension,
                      const std::string& name) {
  if (extension == "ply") {
    return ParsePly(bytes, name, {.allow_non_finite = true}).vertices;
  }
  if (extension == "pcd") return ParsePcd(bytes, name);
  if (extension == "obj") return ParseObj(bytes, name).vertices;
  if (extension == "xyz" || extension == "txt") return ParseXyz(bytes, name);
  if (extension == "npy") return ParseNpyPoints(bytes, name);
  throw InputError(name + ": extension " + Quoted(extension) +
                   ": expected a point cloud, one of " +
                   Join(PointExtensions()));
}

// Moves the finite points to the front; returns how many others there were and
// the place of the first of them.
struct NonFinite {
  Eigen::Index count = 0;
  Eigen::Index first = -1;
};
NonFinite DropNonFinite(Points* points) {
  NonFinite bad;
  Eigen::Index kept = 0;
  for (Eigen::Index i = 0; i < points->cols(); ++i) {
    if (points->col(i).allFinite()) {
      points->col(kept++) = points->col(i);
    } else if (bad.count++ == 0) {
      bad.first = i;
    }
  }
  points->conservativeResize(3, kept);
  return bad;
}

}  // namespace

void Describe(OptionTable* table, PointReadOptions* o) {
  table->Add("drop_non_finite",
             &o->drop_non_finite,
             {.doc = "drop points that are not finite instead of refusing the "
                     "file"});
}

const std::vector<std::string>& PointExtensions() {
  static const std::vector<std::string> extensions = {
      "ply", "pcd", "obj", "xyz", "txt", "npy"};
  return extensions;
}

Points ParsePoints(std::string_view bytes,
                   const std::string& extension,
                   const std::string& name,
                   const PointReadOptions& options,
                   int* num_dropped) {
  Points points = ParseAnyPoints(bytes, extension, name);
  const Eigen::Index num_read = points.cols();
  if (num_read == 0) {
    throw InputError(name + ": no point: expected at least one");
  }
  const NonFinite bad = DropNonFinite(&points);
  if (bad.count > 0 && (!options.drop_non_finite || points.cols() == 0)) {
    throw InputError(name + ": " + std::to_string(bad.count) + " of " +
                     std::to_string(num_read) +
                     " points are not finite, the first is point " +
                     std::to_string(bad.first) +
                     " (from 0): expected finite ones");
  }
  if (num_dropped != nullptr) *num_dropped = static_cast<int>(bad.count);
  return points;
}

Points ReadPoints(const std::string& path,
                  const PointReadOptions& options,
                  int* num_dropped) {
  return ParsePoints(
      ReadFileBytes(path), LowerExtension(path), path, options, num_dropped);
}

}  // namespace invsim
