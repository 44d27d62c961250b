// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/measurement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

#include "invsim/base/error.h"
#include "invsim/geometry/sampling.h"
#include "invsim/study/visible_surface.h"

namespace invsim {
namespace {

constexpr double kWavelength = 0.6;  // m, of the uneven density
constexpr int kMostTries = 200;      // per point wanted
// A camera's ray starts this far off the surface.
constexpr double kOffSurface = 1e-4;  // m
// Random streams below 2^32 are the frames'.
constexpr std::uint64_t kDensityStream = std::uint64_t{1} << 40;

Vector3d RandomDirection(Random* random) {
  Vector3d d;
  do {
    d = Vector3d(random->Normal(), random->Normal(), random->Normal());
  } while (d.norm() < 1e-6);
  return d.normalized();
}

// Faces that subdivide `faces` n times, and for the last level the parents.
Faces Subdivided(const Faces& faces, int n, std::vector<Eigen::Matrix2Xi>* p) {
  TriangleMesh mesh;
  mesh.vertices = Points::Zero(3, faces.size() ? faces.maxCoeff() + 1 : 0);
  mesh.faces = faces;
  for (int k = 0; k < n; ++k) {
    Subdivision s = SubdivideMidpoint(mesh);
    p->push_back(std::move(s.parents));
    mesh = std::move(s.mesh);
  }
  return mesh.faces;
}

// What one camera sees: points with nothing between them and it.
class Camera {
 public:
  Camera(const TriangleMesh& body, const SurfaceIndex& cloth, Vector3d eye)
      : body_(body.vertices, body.faces), cloth_(cloth), eye_(eye) {}

  bool Sees(const Vector3d& point) const {
    const Vector3d way = eye_ - point;
    const double length = way.norm();
    const Vector3d start = point + kOffSurface / length * way;
    return !body_.AnyHit(start, way, length) &&
           !cloth_.AnyHit(start, way, length);
  }

 private:
  SurfaceIndex body_;
  const SurfaceIndex& cloth_;
  Vector3d eye_;
};

bool InHole(const Points& holes, double radius, const Vector3d& p) {
  return holes.cols() > 0 &&
         (holes.colwise() - p).colwise().norm().minCoeff() < radius;
}

[[noreturn]] void ThrowNothingSeen(int frame) {
  throw InputError(
      "measurement: next to nothing of the surface can be seen in frame " +
      std::to_string(frame) +
      "; expected fewer or smaller holes, or another camera");
}

}  // namespace

void Describe(OptionTable* table, MeasurementOptions* o) {
  table->Add("points",
             &o->points,
             {.doc = "points per frame", .at_least = 1, .at_most = 1e7});
  table->Add("noise",
             &o->noise,
             {.doc = "standard deviation of each coordinate",
              .unit = "m",
              .at_least = 0});
  table->Add("subdivisions",
             &o->subdivisions,
             {.doc = "of the body, before what is covered is taken away",
              .at_least = 0,
              .at_most = 3});
  table->Add("cover_reach",
             &o->cover_reach,
             {.doc = "cloth this close along the normal hides the skin",
              .unit = "m",
              .above = 0});
  table->Add(
      "outliers",
      &o->outliers,
      {.doc = "share of points that lie wrong", .at_least = 0, .at_most = 0.9});
  table->Add("outlier_distance",
             &o->outlier_distance,
             {.doc = "by how much at most", .unit = "m", .at_least = 0});
  table->Add("holes",
             &o->holes,
             {.doc = "places per frame where nothing is measured",
              .at_least = 0,
              .at_most = 10000});
  table->Add("hole_radius",
             &o->hole_radius,
             {.doc = "of such a place", .unit = "m", .at_least = 0});
  table->Add("density_ratio",
             &o->density_ratio,
             {.doc = "of the densest to the sparsest place",
              .at_least = 1,
              .at_most = 100});
  table->Add("single_view",
             &o->single_view,
             {.doc = "whether there is one camera only"});
  table->Add("camera_direction",
             &o->camera_direction,
             {.doc = "of that camera, seen from the body"});
  table->Add("camera_distance",
             &o->camera_distance,
             {.doc = "of that camera from the body's middle in frame 0",
              .unit = "m",
              .at_least = 0.5});
}

Scanner::Scanner(const Faces& body_faces,
                 const Faces& cloth_faces,
                 const MeasurementOptions& options,
                 std::uint64_t seed)
    : cloth_faces_(cloth_faces), options_(options), seed_(seed) {
  if (options_.single_view && options_.camera_direction.norm() < 1e-9)
    throw UsageError(
        "measurement.camera_direction is zero; expected a direction");
  body_faces_ = Subdivided(body_faces, options_.subdivisions, &parents_);
  Random random(seed_, kDensityStream);
  for (int k = 0; k < 3; ++k) {
    const Vector3d direction = RandomDirection(&random);
    waves_.push_back({direction, random.Uniform(0, 2 * std::numbers::pi)});
  }
}

double Scanner::Density(const Vector3d& point) const {
  double sum = 0;
  for (const Wave& wave : waves_)
    sum += std::sin(2 * std::numbers::pi / kWavelength *
                        wave.direction.dot(point) +
                    wave.phase);
  // sum / 3 in [-1, 1] to [1 / ratio, 1].
  return std::pow(options_.density_ratio, 0.5 * (sum / 3 - 1));
}

Points Scanner::SubdividedSkin(const Points& body) const {
  Points skin = body;
  for (const Eigen::Matrix2Xi& parents : parents_) {
    Points next(3, parents.cols());
    for (int i = 0; i < next.cols(); ++i)
      next.col(i) = 0.5 * (skin.col(parents(0, i)) + skin.col(parents(1, i)));
    skin = std::move(next);
  }
  return skin;
}

void Scanner::Disturb(Random* random, Measurement* m) const {
  for (int i = 0; i < m->points.cols(); ++i) {
    if (options_.outliers > 0 && random->Uniform() < options_.outliers) {
      m->origins[i] = PointOrigin::kOutlier;
      const double distance = options_.outlier_distance * random->Uniform();
      m->points.col(i) += distance * RandomDirection(random);
    }
    for (int c = 0; c < 3; ++c)
      m->points(c, i) += options_.noise * random->Normal();
  }
}

Measurement Scanner::Measure(int frame,
                             const Points& body,
                             const Points& cloth,
                             const Vector3d& center) const {
  const TriangleMesh skin{SubdividedSkin(body), body_faces_};
  const SurfaceIndex cloth_index(cloth, cloth_faces_);
  const VisibleSurface visible =
      FindVisibleSurface(skin, cloth_index, {.reach = options_.cover_reach});
  Random random(seed_, static_cast<std::uint64_t>(frame));
  std::vector<SurfaceSample> samples;
  const auto draw = [&](int count) {
    const TriangleMesh& mesh = visible.mesh;
    samples = SampleSurface(mesh.vertices, mesh.faces, count, &random);
    return SamplePositions(mesh.vertices, mesh.faces, samples);
  };
  const Points holes = options_.holes > 0 ? draw(options_.holes) : Points(3, 0);
  std::unique_ptr<Camera> camera;
  if (options_.single_view) {
    const Vector3d direction = options_.camera_direction.normalized();
    camera = std::make_unique<Camera>(
        skin, cloth_index, center + options_.camera_distance * direction);
  }
  const auto measured = [&](const Vector3d& p) {
    return (options_.density_ratio == 1 || random.Uniform() < Density(p)) &&
           !InHole(holes, options_.hole_radius, p) &&
           (!camera || camera->Sees(p));
  };

  Measurement m;
  m.points.resize(3, options_.points);
  int done = 0;
  for (int tries = 0; done < options_.points; ++tries) {
    if (tries == kMostTries) ThrowNothingSeen(frame);
    const Points at = draw(options_.points);
    for (int i = 0; i < at.cols() && done < options_.points; ++i) {
      if (!measured(at.col(i))) continue;
      m.points.col(done++) = at.col(i);
      m.origins.push_back(samples[i].face < visible.cloth_faces
                              ? PointOrigin::kCloth
                              : PointOrigin::kSkin);
    }
  }
  Disturb(&random, &m);
  return m;
}

}  // namespace invsim
