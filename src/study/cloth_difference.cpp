// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/cloth_difference.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

#include "invsim/base/error.h"
#include "invsim/geometry/chamfer.h"
#include "invsim/io/ply.h"
#include "invsim/io/point_sequence.h"

namespace invsim {
namespace {

constexpr double kMillimetres = 1000;

PointSequence Frames(const std::string& run) {
  return ScanPointSequence((std::filesystem::path(run) / "cloth").string());
}

PlyMesh Cloth(const std::string& file) {
  PlyMesh mesh = ReadPly(file);
  if (mesh.faces.cols() == 0)
    throw InputError(file + ": no faces, expected a garment");
  return mesh;
}

// Vertices of other meshes are others, however many there are.
bool SameMesh(const PlyMesh& a, const PlyMesh& b) {
  return a.vertices.cols() == b.vertices.cols() &&
         a.faces.cols() == b.faces.cols() && a.faces == b.faces;
}

double SurfaceDistance(const PlyMesh& a, const PlyMesh& b) {
  const SurfaceIndex of_a(a.vertices, a.faces), of_b(b.vertices, b.faces);
  return 0.5 * (DistancesToSurface(a.vertices, of_b).mean() +
                DistancesToSurface(b.vertices, of_a).mean());
}

}  // namespace

double ClothDifference::mean_surface_mm() const {
  return std::accumulate(surface_mm.begin(), surface_mm.end(), 0.0) /
         static_cast<double>(surface_mm.size());
}

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
    const PlyMesh x = Cloth(a.files[t]), y = Cloth(b.files[t]);
    d.surface_mm.push_back(kMillimetres * SurfaceDistance(x, y));
    if (!SameMesh(x, y)) continue;
    const VectorXd distance =
        kMillimetres * (x.vertices - y.vertices).colwise().norm();
    d.rms_mm.push_back(std::sqrt(distance.squaredNorm() /
                                 static_cast<double>(distance.size())));
    sum += distance.mean();
    d.max_mm = std::max(d.max_mm, distance.maxCoeff());
  }
  d.mean_mm = sum / static_cast<double>(a.files.size());
  return d;
}

}  // namespace invsim
