// SPDX-License-Identifier: Apache-2.0
#include "invsim/contact/cloth_contact.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <span>

#include "invsim/base/threads.h"
#include "invsim/geometry/box_overlap.h"
#include "invsim/geometry/mesh.h"
#include "invsim/geometry/self_intersection.h"

namespace invsim {
namespace {

// The sweep keeps this share of the thickness as its gap, see Gap().
constexpr double kGap = 0.1;
// The least share of its distance by which a pair may come nearer in a step.
constexpr double kLeastGain = 1e-3;
// Pairs nearer than this are touching: there is no telling on which side.
constexpr double kCrossing = 1e-9;  // m
// How much of the distance in which they were made neighbours keep, at most.
constexpr double kMadeShare = 0.5;
// Two faces give the same contact if a vertex is as near to both.
constexpr double kSameDistance = 1e-9;  // m
// Sine squared below which edges are parallel and met by their ends.
constexpr double kParallel = 1e-4;
// Rings of faces round those that cross in which cloth is not kept apart.
constexpr int kRings = 2;
// Stopping scales the ways down so often before it takes them away.
constexpr int kScalings = 10;
constexpr double kShareKept = 0.9;

bool Shares(std::span<const int> a, std::span<const int> b) {
  for (const int i : a)
    for (const int j : b)
      if (i == j) return true;
  return false;
}

struct Box {
  Vector3d low, high;
  bool Meets(const Box& other) const {
    return (low.array() <= other.high.array()).all() &&
           (other.low.array() <= high.array()).all();
  }
};

// The contact of nearest points with the feature they lie on, or nothing of
// edges that are nearest at an end: there vertices and faces see to it.
bool MakeSource(const ElementPair& pair,
                const Eigen::Vector4d& weights,
                ClothContact* source) {
  source->vertex.fill(-1);
  int count = 0;
  for (int k = 0; k < 4; ++k)
    if (weights[k] != 0) source->vertex[count++] = pair.vertex[k];
  if (pair.kind == PairKind::kEdgeEdge && count < 4) return false;
  source->feature = pair.kind == PairKind::kEdgeEdge ? PairFeature::kEdgeEdge
                    : count == 4                     ? PairFeature::kVertexFace
                    : count == 3                     ? PairFeature::kVertexEdge
                                 : PairFeature::kVertexVertex;
  return true;
}

// The least distance to which a pair may come that starts at `distance`: `full`
// if there is that much, else half way nearer at most, and less and less
// the nearer it is. Pairs pressed together step after step (n steps) by a body
// that closes on them come down to about full / n, not to full / 2^n, which
// would soon be rounding.
double Gap(double full, double distance) {
  const double gain =
      0.5 * std::clamp(distance / full, kLeastGain, 1.0) * distance;
  return std::min(full, distance - gain);
}

bool IsBorder(PairFeature feature) {
  return feature == PairFeature::kVertexVertex ||
         feature == PairFeature::kVertexEdge;
}

}  // namespace

struct ClothContactDetector::Impl {
  Impl(const SelfContact& effect, const Faces& f, const VectorXd& m);

  // A pair that may come near, with its distance at the start.
  struct Candidate {
    ElementPair pair;
    NearestPoints nearest;
    double reach;  // within which it is a contact
  };

  Box Union(std::span<const int> vertices) const;
  void FindCandidates(const Points& x1);
  void Cover(const Points& x1);
  void FindTangled(const std::vector<std::array<int, 2>>& face_pairs);
  void AddElements(int f, int g);
  void AddIfNear(const ElementPair& pair, const Box& a, const Box& b);
  bool Joined(const ElementPair& pair) const;
  double Thickness(const ElementPair& pair) const;
  bool NearerNeighbour(size_t begin, size_t end, size_t k) const;
  void AddNear(size_t begin,
               size_t end,
               std::vector<Contact>* contacts,
               std::vector<ClothContact>* sources);
  Contact MakeContact(const ClothContact& source,
                      const Eigen::Vector4d& weights,
                      const Vector3d& normal,
                      const Vector3d& velocity) const;
  double Touches(const Candidate& c, const Points& x1) const;
  std::vector<double> TouchTimes(const Points& x1) const;

  SelfContactOptions options;
  Points made;
  Faces faces;
  VectorXd mass;
  std::vector<std::array<int, 2>> edges;
  std::vector<std::vector<int>> around;  // neighbours of each vertex, sorted
  // The vertices and edges that each face stands for, so that each is looked
  // at once.
  std::vector<std::vector<int>> own_vertices, own_edges;

  // Of the last Detect.
  double dt = 0;
  Points x0, v0;
  Points low, high;           // boxes within which vertices are followed
  std::vector<char> tangled;  // per vertex
  int crossings = 0;
  std::vector<Candidate> candidates;    // sorted by pair
  std::map<ElementPair, size_t> swept;  // their contact among the sources
};

ClothContactDetector::Impl::Impl(const SelfContact& effect,
                                 const Faces& f,
                                 const VectorXd& m)
    : options(effect.options()), made(effect.made()), faces(f), mass(m) {
  own_vertices.resize(faces.cols());
  own_edges.resize(faces.cols());
  around.resize(mass.size());
  std::vector<char> owned(mass.size(), 0);
  for (int face = 0; face < faces.cols(); ++face) {
    for (const int v : faces.col(face)) {
      if (!owned[v]) own_vertices[face].push_back(v);
      owned[v] = 1;
    }
  }
  for (const Edge& e : Edges(faces)) {
    own_edges[e.faces[0]].push_back(static_cast<int>(edges.size()));
    edges.push_back({e.a, e.b});
    around[e.a].push_back(e.b);
    around[e.b].push_back(e.a);
  }
  for (std::vector<int>& neighbours : around) std::ranges::sort(neighbours);
}

Box ClothContactDetector::Impl::Union(std::span<const int> vertices) const {
  Box box{low.col(vertices[0]), high.col(vertices[0])};
  for (const int v : vertices) {
    box.low = box.low.cwiseMin(low.col(v));
    box.high = box.high.cwiseMax(high.col(v));
  }
  return box;
}

void ClothContactDetector::Impl::AddIfNear(const ElementPair& pair,
                                           const Box& a,
                                           const Box& b) {
  if (!a.Meets(b)) return;
  const size_t first = pair.kind == PairKind::kVertexFace ? 1 : 2;
  const std::span<const int> all = pair.vertex;
  if (Shares(all.first(first), all.subspan(first))) return;
  const auto tangle = [&](int v) { return tangled[v] != 0; };
  if (std::ranges::any_of(all.first(first), tangle) &&
      std::ranges::any_of(all.subspan(first), tangle))
    return;
  candidates.push_back({pair, {}, 0});
}

void ClothContactDetector::Impl::AddElements(int f, int g) {
  const Box box_f = Union({faces.col(f).data(), 3});
  const Box box_g = Union({faces.col(g).data(), 3});
  const auto vertex_face = [&](int v, int face, const Box& box) {
    AddIfNear({PairKind::kVertexFace,
               {v, faces(0, face), faces(1, face), faces(2, face)}},
              {low.col(v), high.col(v)},
              box);
  };
  for (const int v : own_vertices[f]) vertex_face(v, g, box_g);
  for (const int v : own_vertices[g]) vertex_face(v, f, box_f);
  for (const int a : own_edges[f]) {
    const Box box_a = Union(edges[a]);
    if (!box_a.Meets(box_g)) continue;
    for (const int b : own_edges[g]) {
      const auto& [p, q] = edges[std::min(a, b)];
      const auto& [r, s] = edges[std::max(a, b)];
      AddIfNear({PairKind::kEdgeEdge, {p, q, r, s}}, box_a, Union(edges[b]));
    }
  }
}

// The vertices of faces that cross at the start and of kRings of faces round
// them.
void ClothContactDetector::Impl::FindTangled(
    const std::vector<std::array<int, 2>>& face_pairs) {
  std::vector<char> crossed(face_pairs.size(), 0);
  ParallelFor(static_cast<int>(face_pairs.size()), 64, [&](int k) {
    crossed[k] = FacesCross(x0, faces, face_pairs[k][0], face_pairs[k][1]);
  });
  tangled.assign(mass.size(), 0);
  crossings = 0;
  for (size_t k = 0; k < face_pairs.size(); ++k) {
    if (!crossed[k]) continue;
    ++crossings;
    for (const int f : face_pairs[k])
      for (const int v : faces.col(f)) tangled[v] = 1;
  }
  for (int ring = 0; crossings > 0 && ring < kRings; ++ring) {
    const std::vector<char> core = tangled;
    for (size_t v = 0; v < core.size(); ++v)
      if (core[v])
        for (const int w : around[v]) tangled[w] = 1;
  }
}

// Looks anew where a vertex leaves the box that its way was thought to be in.
void ClothContactDetector::Impl::Cover(const Points& x1) {
  if ((x1.array() < low.array()).any() || (x1.array() > high.array()).any())
    FindCandidates(x1);
}

// All pairs whose boxes, round the way of each vertex from x0 to x1 and a
// margin, meet.
void ClothContactDetector::Impl::FindCandidates(const Points& x1) {
  const double room = options.thickness + options.margin;
  low = x0.cwiseMin(x1).array() - room;
  high = x0.cwiseMax(x1).array() + room;
  Points face_low(3, faces.cols()), face_high(3, faces.cols());
  for (int f = 0; f < faces.cols(); ++f) {
    const Box box = Union({faces.col(f).data(), 3});
    face_low.col(f) = box.low;
    face_high.col(f) = box.high;
  }
  const auto pairs = OverlappingBoxes(face_low, face_high);
  FindTangled(pairs);
  candidates.clear();
  for (const auto& [f, g] : pairs) AddElements(f, g);
  std::ranges::sort(candidates, {}, &Candidate::pair);
  ParallelFor(static_cast<int>(candidates.size()), 512, [&](int k) {
    Candidate& c = candidates[k];
    c.nearest = Nearest(c.pair.kind, Corners(x0, c.pair));
    c.reach = room + dt * (Corners(v0, c.pair) * c.nearest.weights).norm();
  });
}

// Whether an edge, or two, lead from one element to the other.
bool ClothContactDetector::Impl::Joined(const ElementPair& pair) const {
  const int first = pair.kind == PairKind::kVertexFace ? 1 : 2;
  for (int i = 0; i < first; ++i) {
    for (int j = first; j < 4; ++j) {
      const auto& a = around[pair.vertex[i]];
      const auto& b = around[pair.vertex[j]];
      if (std::ranges::binary_search(a, pair.vertex[j]) || Shares(a, b))
        return true;
    }
  }
  return false;
}

double ClothContactDetector::Impl::Thickness(const ElementPair& pair) const {
  if (!Joined(pair)) return options.thickness;
  return std::min(
      options.thickness,
      kMadeShare * Nearest(pair.kind, Corners(made, pair)).distance);
}

Contact ClothContactDetector::Impl::MakeContact(
    const ClothContact& source,
    const Eigen::Vector4d& weights,
    const Vector3d& normal,
    const Vector3d& velocity) const {
  Contact contact;
  double inverse_mass = 0;
  contact.num_vertices = 0;
  for (int k = 0; k < 4 && source.vertex[k] >= 0; ++k) {
    contact.vertex[k] = source.vertex[k];
    contact.weight[k] = weights[k];
    inverse_mass += 1 / mass[source.vertex[k]];
    ++contact.num_vertices;
  }
  contact.normal = normal;
  contact.velocity = velocity;
  contact.friction = options.friction;
  contact.compliance =
      options.compliance * dt * inverse_mass / contact.num_vertices;
  return contact;
}

// Whether a vertex, nearest to a face at its border, is nearer to another that
// shares a corner with it: then that is no minimum of the distance.
bool ClothContactDetector::Impl::NearerNeighbour(size_t begin,
                                                 size_t end,
                                                 size_t k) const {
  const Candidate& c = candidates[k];
  for (size_t j = begin; j < end; ++j) {
    const Candidate& other = candidates[j];
    if (other.nearest.distance < c.nearest.distance - kSameDistance &&
        Shares(std::span<const int>(c.pair.vertex).last(3),
               std::span<const int>(other.pair.vertex).last(3)))
      return true;
  }
  return false;
}

// The contacts among candidates [begin, end), which are those of one vertex,
// or one pair of edges.
void ClothContactDetector::Impl::AddNear(size_t begin,
                                         size_t end,
                                         std::vector<Contact>* contacts,
                                         std::vector<ClothContact>* sources) {
  for (size_t k = begin; k < end; ++k) {
    const Candidate& c = candidates[k];
    const double d = c.nearest.distance;
    ClothContact source;
    if (d > c.reach || d < kCrossing ||
        !MakeSource(c.pair, c.nearest.weights, &source))
      continue;
    const PairPoints x = Corners(x0, c.pair);
    if (source.feature == PairFeature::kEdgeEdge) {
      const Vector3d p = x.col(1) - x.col(0), q = x.col(3) - x.col(2);
      const Vector3d normal = p.cross(q);
      if (normal.squaredNorm() < kParallel * p.squaredNorm() * q.squaredNorm())
        continue;
      source.side = normal.dot(c.nearest.offset) > 0 ? 1 : -1;
    } else if (source.feature == PairFeature::kVertexFace) {
      const Vector3d normal = (x.col(2) - x.col(1)).cross(x.col(3) - x.col(1));
      source.side = normal.dot(c.nearest.offset) > 0 ? 1 : -1;
    } else {
      source.side = 1;
      if (NearerNeighbour(begin, end, k)) continue;
    }
    source.thickness = Thickness(c.pair);
    // The plane across the offset from a border stops what would slide past
    // it. It is needed only where the thickness is not kept.
    if (IsBorder(source.feature) && d >= source.thickness) continue;
    PairPoints corners = PairPoints::Zero();
    for (int j = 0; j < 4 && source.vertex[j] >= 0; ++j)
      corners.col(j) = x0.col(source.vertex[j]);
    const ClothPlane plane = EvaluateClothPlane(options, dt, source, corners);
    source.contact = static_cast<int>(contacts->size());
    contacts->push_back(
        MakeContact(source, plane.weights, plane.normal, plane.velocity));
    sources->push_back(source);
  }
}

// When the pair touches on its way to x1, or kNever.
double ClothContactDetector::Impl::Touches(const Candidate& c,
                                           const Points& x1) const {
  if (c.nearest.distance < kCrossing) return kNever;
  return FirstTimeWithin(Gap(kGap * options.thickness, c.nearest.distance),
                         c.pair.kind,
                         Corners(x0, c.pair),
                         Corners(x1, c.pair));
}

std::vector<double> ClothContactDetector::Impl::TouchTimes(
    const Points& x1) const {
  std::vector<double> times(candidates.size());
  ParallelFor(static_cast<int>(times.size()), 512, [&](int k) {
    times[k] = Touches(candidates[k], x1);
  });
  return times;
}

ClothContactDetector::ClothContactDetector(const SelfContact& effect,
                                           const Faces& faces,
                                           const VectorXd& mass)
    : impl_(std::make_unique<Impl>(effect, faces, mass)) {}
ClothContactDetector::~ClothContactDetector() = default;

const SelfContactOptions& ClothContactDetector::options() const {
  return impl_->options;
}
int ClothContactDetector::crossings() const { return impl_->crossings; }

void ClothContactDetector::Detect(double dt,
                                  const Points& x0,
                                  const Points& v0,
                                  std::vector<Contact>* contacts,
                                  std::vector<ClothContact>* sources) {
  Impl& s = *impl_;
  s.dt = dt;
  s.x0 = x0;
  s.v0 = v0;
  s.swept.clear();
  s.FindCandidates(x0 + dt * v0);
  // A vertex and an edge, or two vertices, come from several faces.
  const size_t first = sources->size();
  for (size_t begin = 0; begin < s.candidates.size();) {
    const ElementPair& pair = s.candidates[begin].pair;
    size_t end = begin + 1;
    while (pair.kind == PairKind::kVertexFace && end < s.candidates.size() &&
           s.candidates[end].pair.kind == pair.kind &&
           s.candidates[end].pair.vertex[0] == pair.vertex[0])
      ++end;
    s.AddNear(begin, end, contacts, sources);
    begin = end;
  }
  std::map<std::array<int, 4>, int> seen;
  size_t kept = first;
  size_t to = first < sources->size() ? (*sources)[first].contact : 0;
  for (size_t k = first; k < sources->size(); ++k) {
    ClothContact source = (*sources)[k];
    if (source.feature != PairFeature::kEdgeEdge) {
      std::array<int, 4> key = source.vertex;
      const bool two = source.feature == PairFeature::kVertexVertex;
      std::sort(key.begin() + (two ? 0 : 1), key.begin() + (two ? 2 : 4));
      if (!seen.try_emplace(key, 0).second) continue;
    }
    (*contacts)[to] = (*contacts)[source.contact];
    source.contact = static_cast<int>(to++);
    (*sources)[kept++] = source;
  }
  if (first < sources->size()) contacts->resize(to);
  sources->resize(kept);
}

int ClothContactDetector::Sweep(const Points& x1,
                                std::vector<Contact>* contacts,
                                std::vector<ClothContact>* sources) {
  Impl& s = *impl_;
  s.Cover(x1);
  const std::vector<double> times = s.TouchTimes(x1);
  int touching = 0;
  for (size_t k = 0; k < times.size(); ++k) {
    if (times[k] == kNever) continue;
    ++touching;
    const ElementPair& pair = s.candidates[k].pair;
    const PairPoints start = Corners(s.x0, pair);
    const NearestPoints at =
        Nearest(pair.kind, start + times[k] * (Corners(x1, pair) - start));
    ClothContact source;
    source.vertex = pair.vertex;
    source.feature = pair.kind == PairKind::kEdgeEdge
                         ? PairFeature::kEdgeEdge
                         : PairFeature::kVertexFace;
    source.side = 1;
    source.thickness = s.Thickness(pair);
    source.swept = true;
    const Vector3d normal = at.offset / at.distance;
    const double distance = normal.dot(start * at.weights);
    const double approach = std::min((source.thickness - distance) / s.dt,
                                     s.options.recovery_speed);
    const auto [known, fresh] = s.swept.try_emplace(pair, sources->size());
    if (fresh) {
      source.contact = static_cast<int>(contacts->size());
      contacts->emplace_back();
      sources->push_back(source);
    }
    (*contacts)[(*sources)[known->second].contact] =
        s.MakeContact(source, at.weights, normal, approach * normal);
  }
  return touching;
}

VectorXd ClothContactDetector::Stop(const Points& x1) {
  Impl& s = *impl_;
  s.Cover(x1);  // what moves less far is covered with it
  VectorXd share = VectorXd::Ones(x1.cols());
  for (int scaling = 0;; ++scaling) {
    const Points moved =
        s.x0 +
        ((x1 - s.x0).array().rowwise() * share.transpose().array()).matrix();
    const std::vector<double> times = s.TouchTimes(moved);
    const VectorXd before = share;
    bool free = true;
    for (size_t k = 0; k < times.size(); ++k) {
      if (times[k] == kNever) continue;
      free = false;
      double least = 1;
      for (const int v : s.candidates[k].pair.vertex)
        least = std::min(least, before[v]);
      const double to = scaling < kScalings ? kShareKept * times[k] * least : 0;
      for (const int v : s.candidates[k].pair.vertex)
        share[v] = std::min(share[v], to);
    }
    if (free) return share;
  }
}

}  // namespace invsim
