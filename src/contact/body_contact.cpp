// SPDX-License-Identifier: Apache-2.0
#include "invsim/contact/body_contact.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "invsim/base/options.h"
#include "invsim/base/threads.h"
#include "invsim/geometry/surface_index.h"
#include "slipped_vertices.h"

namespace invsim {
namespace {

// The directions of an edge or vertex contact closer than this are rounding
// noise; the face's normal is taken instead.
constexpr double kTouching = 1e-5;

// Two faces give the same contact if their closest points do.
constexpr double kSamePoint = 1e-9;
// No way out of a body is sought beyond this, m: a vertex said to be inside
// that finds none has come out.
constexpr double kDeepest = 0.1;

// A local minimum of the distance from a cloth vertex to the surface.
struct Minimum {
  FacePoint at;
  Vector3d normal;  // pseudo-normal, not normalised
  double side;
};

double Angle(const Matrix3d& corners, int k) {
  const Vector3d a = corners.col((k + 1) % 3) - corners.col(k);
  const Vector3d b = corners.col((k + 2) % 3) - corners.col(k);
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

void Describe(OptionTable* table, BodyContactOptions* o) {
  table->Add("thickness",
             &o->thickness,
             {.doc = "distance kept between cloth and body",
              .unit = "m",
              .at_least = 0});
  table->Add("friction",
             &o->friction,
             {.doc = "Coulomb friction of cloth on the body", .at_least = 0});
  table->Add("margin",
             &o->margin,
             {.doc = "distance beyond the thickness in which contacts are "
                     "sought, besides what relative motion needs",
              .unit = "m",
              .above = 0});
  table->Add("recovery_speed",
             &o->recovery_speed,
             {.doc = "fastest way out of the body for a vertex inside it",
              .unit = "m/s",
              .above = 0});
  table->Add(
      "shared_compliance",
      &o->shared_compliance,
      {.doc = "compliance of contacts that share a vertex, as a share of "
              "the vertex's own",
       .above = 0});
}

struct BodyContactDetector::Impl {
  Impl(const Points& body, const Faces& faces) : surface(body, faces) {}

  Matrix3d Corners(const Points& body, int face) const {
    Matrix3d corners;
    for (int k = 0; k < 3; ++k)
      corners.col(k) = body.col(surface.faces()(k, face));
    return corners;
  }
  // Surface velocity at a point of a face.
  Vector3d Velocity(const Points& body0,
                    const Points& body1,
                    const FacePoint& at,
                    double dt) const {
    return (Corners(body1, at.face) - Corners(body0, at.face)) * at.weights /
           dt;
  }
  void Find(const Vector3d& x,
            bool has_way_out,
            double radius,
            std::vector<Minimum>* minima) const;
  void Minima(const Vector3d& x,
              const std::vector<FacePoint>& near,
              std::vector<Minimum>* minima) const;
  void DropUnphysical(const Vector3d& x, std::vector<Minimum>* minima) const;
  Contact MakeContact(const BodyContactOptions& options,
                      double dt,
                      const Points& body0,
                      const Points& body1,
                      const Points& x0,
                      const BodyContact& source) const;

  SurfaceIndex surface;
  // Per cloth vertex: inside the body when last looked at.
  std::vector<char> inside;
};

BodyContactDetector::BodyContactDetector(const Points& body, const Faces& faces)
    : impl_(std::make_unique<Impl>(body, faces)) {}
BodyContactDetector::~BodyContactDetector() = default;

const Faces& BodyContactDetector::faces() const {
  return impl_->surface.faces();
}

// All within `radius`; of a vertex inside the body at least one way out, which
// may lie further than another part of the body that is in front of it.
void BodyContactDetector::Impl::Find(const Vector3d& x,
                                     bool has_way_out,
                                     double radius,
                                     std::vector<Minimum>* minima) const {
  std::vector<FacePoint> near;
  if (has_way_out)
    radius = std::max(radius, surface.Nearest(x).distance + 1e-3);
  for (;; radius *= 2) {
    surface.Within(x, radius, &near);
    Minima(x, near, minima);
    DropUnphysical(x, minima);
    if (!has_way_out || radius > kDeepest ||
        std::any_of(minima->begin(), minima->end(), [](const Minimum& m) {
          return m.side < 0;
        }))
      return;
  }
}

// The foot of a perpendicular on a face is a local minimum, and so is a point
// on a face's border if no face that shares a corner with it comes closer.
// Faces that meet in the closest point are one minimum, whose pseudo-normal is
// the angle-weighted sum of theirs.
void BodyContactDetector::Impl::Minima(const Vector3d& x,
                                       const std::vector<FacePoint>& near,
                                       std::vector<Minimum>* minima) const {
  minima->clear();
  const Faces& faces = surface.faces();
  // By corner, the distances of the faces round it, the least one first. All of
  // the body is near if it moves by its own size.
  std::vector<std::pair<int, double>> round;
  round.reserve(3 * near.size());
  for (const FacePoint& q : near)
    for (int b = 0; b < 3; ++b) round.push_back({faces(b, q.face), q.distance});
  std::sort(round.begin(), round.end());
  const auto closer_neighbour = [&](const FacePoint& p) {
    for (int a = 0; a < 3; ++a) {
      const auto least = std::lower_bound(
          round.begin(), round.end(), std::pair(faces(a, p.face), 0.0));
      if (least->second < p.distance - kSamePoint) return true;
    }
    return false;
  };
  for (const FacePoint& p : near) {
    if (p.feature != TriangleFeature::kFace && closer_neighbour(p)) continue;
    const Matrix3d corners = Corners(surface.vertices(), p.face);
    Vector3d normal = (corners.col(1) - corners.col(0))
                          .cross(corners.col(2) - corners.col(0));
    const double length = normal.norm();
    if (length == 0) continue;
    normal /= length;
    if (IsVertex(p.feature)) normal *= Angle(corners, FeatureCorner(p.feature));
    auto same =
        std::find_if(minima->begin(), minima->end(), [&](const Minimum& m) {
          return (m.at.point - p.point).squaredNorm() < kSamePoint * kSamePoint;
        });
    if (same == minima->end())
      minima->push_back({p, normal, 0});
    else
      same->normal += normal;
  }
  for (Minimum& m : *minima) m.side = m.normal.dot(x - m.at.point) < 0 ? -1 : 1;
}

// Surface seen from behind is either the far side of a thin part, which is no
// obstacle, or the vertex is inside the body. Then the nearest way out counts,
// and a second one if the vertex is inside two parts that overlap.
void BodyContactDetector::Impl::DropUnphysical(
    const Vector3d& x, std::vector<Minimum>* minima) const {
  const auto behind = [](const Minimum& m) { return m.side < 0; };
  const auto first_behind = std::stable_partition(
      minima->begin(), minima->end(), [&](const Minimum& m) {
        return !behind(m);
      });
  if (first_behind == minima->end()) return;
  auto keep = first_behind;
  if (surface.Contains(x)) {
    std::stable_sort(
        first_behind, minima->end(), [](const Minimum& a, const Minimum& b) {
          return a.at.distance < b.at.distance;
        });
    const Minimum nearest = *first_behind;
    ++keep;
    for (auto it = keep; it != minima->end(); ++it) {
      if (it->at.distance > 2 * nearest.at.distance + 1e-3) break;
      const double cosine =
          it->normal.normalized().dot(nearest.normal.normalized());
      if (cosine > 0) continue;
      *keep++ = *it;
      break;
    }
  }
  minima->erase(keep, minima->end());
}

int BodyContactDetector::FindInside(const Points& body, const Points& x) {
  Impl& s = *impl_;
  s.surface.Update(body);
  s.inside.assign(x.cols(), 0);
  ParallelFor(static_cast<int>(x.cols()), 64, [&](int i) {
    s.inside[i] = s.surface.Contains(x.col(i));
  });
  return static_cast<int>(std::count(s.inside.begin(), s.inside.end(), 1));
}

void BodyContactDetector::Detect(const BodyContactOptions& options,
                                 double dt,
                                 const Points& body0,
                                 const Points& body1,
                                 const Points& x0,
                                 const Points& v0,
                                 const VectorXd& resistance,
                                 std::vector<Contact>* contacts,
                                 std::vector<BodyContact>* sources,
                                 const Points* v1) {
  Impl& s = *impl_;
  s.surface.Update(body0);
  const int n = static_cast<int>(x0.cols());
  s.inside.resize(n, 0);
  const double fastest =
      body0.cols() > 0
          ? std::sqrt((body1 - body0).colwise().squaredNorm().maxCoeff()) / dt
          : 0.0;
  std::vector<std::vector<Minimum>> found(n);
  ParallelFor(n, 64, [&](int i) {
    const Vector3d x = x0.col(i);
    const double still = options.thickness + options.margin;
    double speed = v0.col(i).norm();
    if (v1) speed = std::max(speed, v1->col(i).norm());
    s.Find(x, s.inside[i], still + dt * (speed + fastest), &found[i]);
    std::erase_if(found[i], [&](const Minimum& m) {
      const Vector3d body = s.Velocity(body0, body1, m.at, dt);
      double slip = (v0.col(i) - body).norm();
      if (v1) slip = std::max(slip, (v1->col(i) - body).norm());
      return m.side > 0 && m.at.distance > still + dt * slip;
    });
  });
  contacts->clear();
  sources->clear();
  for (int i = 0; i < n; ++i) {
    s.inside[i] = 0;
    for (const Minimum& m : found[i]) {
      if (m.side < 0) s.inside[i] = 1;
      const TriangleFeature feature =
          m.at.distance < kTouching ? TriangleFeature::kFace : m.at.feature;
      sources->push_back({static_cast<int>(contacts->size()),
                          i,
                          m.at.face,
                          feature,
                          m.side,
                          m.at.weights});
      contacts->push_back(
          s.MakeContact(options, dt, body0, body1, x0, sources->back()));
      if (found[i].size() > 1)
        contacts->back().compliance = options.shared_compliance / resistance[i];
    }
  }
}

Contact BodyContactDetector::Impl::MakeContact(
    const BodyContactOptions& options,
    double dt,
    const Points& body0,
    const Points& body1,
    const Points& x0,
    const BodyContact& source) const {
  const ContactPlane plane = EvaluateContactPlane(options,
                                                  dt,
                                                  source.feature,
                                                  source.side,
                                                  x0.col(source.vertex),
                                                  Corners(body0, source.face),
                                                  Corners(body1, source.face));
  Contact contact;
  contact.vertex[0] = source.vertex;
  contact.normal = plane.normal;
  contact.velocity = plane.velocity;
  contact.friction = options.friction;
  return contact;
}

int BodyContactDetector::FindSlipped(const BodyContactOptions& options,
                                     double dt,
                                     const Points& body0,
                                     const Points& body1,
                                     const Points& x0,
                                     const Points& v1,
                                     const VectorXd& resistance,
                                     std::vector<Contact>* contacts,
                                     std::vector<BodyContact>* sources) {
  Impl& s = *impl_;
  const Points x1 = x0 + dt * v1;
  const std::vector<int> off =
      OffTheirFaces(options, dt, faces(), body1, x1, v1, *contacts, *sources);
  if (off.empty()) return 0;
  s.surface.Update(body1);
  std::vector<SurfacePoint> nearest(off.size());
  ParallelFor(static_cast<int>(off.size()), 64, [&](int k) {
    nearest[k] = s.surface.Nearest(x1.col(off[k]));
  });
  std::vector<char> slipped(x0.cols(), 0);
  const size_t known = sources->size();
  for (size_t k = 0; k < off.size(); ++k) {
    const int i = off[k];
    if (nearest[k].signed_distance >= -kLetIn || !s.surface.Contains(x1.col(i)))
      continue;
    slipped[i] = 1;
    sources->push_back({static_cast<int>(contacts->size()),
                        i,
                        nearest[k].face,
                        TriangleFeature::kFace,
                        1,
                        nearest[k].weights});
    contacts->push_back(
        s.MakeContact(options, dt, body0, body1, x0, sources->back()));
  }
  if (sources->size() > known)
    for (const BodyContact& source : *sources)
      if (slipped[source.vertex])
        (*contacts)[source.contact].compliance =
            options.shared_compliance / resistance[source.vertex];
  return static_cast<int>(sources->size() - known);
}

}  // namespace invsim
