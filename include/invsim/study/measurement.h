// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_STUDY_MEASUREMENT_H_
#define INVSIM_STUDY_MEASUREMENT_H_

// Point clouds of a clothed person as a scanner would measure them (the
// paper's section 4.2): from the meshes of body and garment to points.
//
//   1. The body is subdivided, so that the border of what is covered is
//      sharper than its faces. (Subdividing the garment would leave its surface
//      as it is, and points are drawn by area: there is no need.)
//   2. Skin whose outward normal meets the cloth within `cover_reach` is
//      covered and taken away.
//   3. Points are drawn uniformly by area from what is left.
//   4. Each is moved by Gaussian noise, independent in x, y and z.
//
// What goes wrong with real scanners can be asked for: outliers, holes, uneven
// density, and a single camera that sees one side only. Points lost to holes,
// density or the camera's view are drawn anew, so a frame always has `points`
// points.
//
//   Scanner scanner(body.faces(), garment.faces, options, seed);
//   for (int t = 0; t < frames; ++t)
//     Points p = scanner.Measure(t, body_vertices, cloth_vertices).points;
//
// The same seed and frame number give the same points, whatever was measured
// before and on however many threads.

#include <cstdint>
#include <vector>

#include "invsim/base/options.h"
#include "invsim/base/random.h"
#include "invsim/base/types.h"
#include "invsim/geometry/subdivision.h"

namespace invsim {

struct MeasurementOptions {
  int points = 8000;          // per frame
  double noise = 0.003;       // standard deviation of each coordinate, m
  int subdivisions = 1;       // of the body
  double cover_reach = 0.15;  // m
  // This share of the points is moved in a random direction by a distance
  // uniform in [0, outlier_distance].
  double outliers = 0;
  double outlier_distance = 0.2;  // m
  // Balls of `hole_radius` round so many points of the surface, others in each
  // frame, in which nothing is measured.
  int holes = 0;
  double hole_radius = 0.08;  // m
  // How many times denser the densest places are than the sparsest. The
  // density follows a fixed sum of three waves through space of wavelength
  // 0.6 m.
  double density_ratio = 1;
  // One camera, `camera_distance` from the body's middle in frame 0 in the
  // direction `camera_direction`: only what it sees is measured.
  bool single_view = false;
  Vector3d camera_direction = Vector3d(0, 0, 1);
  double camera_distance = 3;  // m
};
void Describe(OptionTable* table, MeasurementOptions* options);

// Where a measured point came from.
enum class PointOrigin : char { kCloth, kSkin, kOutlier };

struct Measurement {
  Points points;                     // 3 x MeasurementOptions::points, m
  std::vector<PointOrigin> origins;  // one per point
};

class Scanner {
 public:
  // Throws InputError if a mesh is not an oriented manifold.
  Scanner(const Faces& body_faces,
          const Faces& cloth_faces,
          const MeasurementOptions& options,
          std::uint64_t seed);

  // `center`: what the camera looks at, the body's middle in frame 0; needed
  // for a single view only. Throws InputError if next to nothing can be seen.
  Measurement Measure(int frame,
                      const Points& body,
                      const Points& cloth,
                      const Vector3d& center = Vector3d::Zero()) const;

 private:
  struct Wave {
    Vector3d direction;
    double phase;
  };

  Points SubdividedSkin(const Points& body) const;
  // Outliers and noise.
  void Disturb(Random* random, Measurement* measurement) const;
  // How likely a point there is kept, (0, 1].
  double Density(const Vector3d& point) const;

  Faces body_faces_;                       // subdivided
  std::vector<Eigen::Matrix2Xi> parents_;  // of each subdivision
  Faces cloth_faces_;
  MeasurementOptions options_;
  std::uint64_t seed_;
  std::vector<Wave> waves_;
};

}  // namespace invsim

#endif  // INVSIM_STUDY_MEASUREMENT_H_
