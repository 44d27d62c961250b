// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/topology.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numeric>

#include "invsim/base/error.h"
#include "invsim/geometry/mesh.h"

namespace invsim {
namespace {

// Twice the area over the longest side squared, below which a face counts as
// having no area.
constexpr double kNoArea = 1e-10;

std::string VertexName(int v) { return "vertex " + std::to_string(v); }
std::string FaceName(int f) { return "face " + std::to_string(f); }

void CheckVertices(const Points& vertices, const std::string& name) {
  for (int i = 0; i < vertices.cols(); ++i)
    if (!vertices.col(i).allFinite())
      throw InputError(name + ": " + VertexName(i) +
                       " is not finite, expected numbers");
}

void CheckFace(const Points& x,
               const Faces& faces,
               int f,
               const std::string& name) {
  for (int c = 0; c < 3; ++c) {
    if (faces(c, f) < 0 || faces(c, f) >= x.cols())
      throw InputError(name + ": " + FaceName(f) + " refers to " +
                       VertexName(faces(c, f)) + ", expected 0 to " +
                       std::to_string(x.cols() - 1));
    if (faces(c, f) == faces((c + 1) % 3, f))
      throw InputError(name + ": " + FaceName(f) + " has " +
                       VertexName(faces(c, f)) + " twice");
  }
  const Vector3d ab = x.col(faces(1, f)) - x.col(faces(0, f));
  const Vector3d ac = x.col(faces(2, f)) - x.col(faces(0, f));
  const double longest =
      std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()});
  if (!(ab.cross(ac).norm() > kNoArea * longest))
    throw InputError(name + ": " + FaceName(f) + " (vertices " +
                     std::to_string(faces(0, f)) + ", " +
                     std::to_string(faces(1, f)) + ", " +
                     std::to_string(faces(2, f)) + ") has no area");
}

Faces NamedNeighbours(const Faces& faces, const std::string& name) {
  try {
    return FaceNeighbours(faces);
  } catch (const InputError& e) {
    throw InputError(name + ": " + e.what());
  }
}

// Walks the faces round a vertex from one to the next; a vertex where two
// cones of faces touch is not reached in one walk.
void CheckFans(const Faces& faces, int num_vertices, const std::string& name) {
  const VertexFaces around(faces, num_vertices);
  const Faces beside = NamedNeighbours(faces, name);
  std::vector<int> stack, seen;
  for (int v = 0; v < num_vertices; ++v) {
    if (around[v].empty())
      throw InputError(name + ": " + VertexName(v) +
                       " belongs to no face, expected one at least");
    stack.assign(1, around[v][0]);
    seen = stack;
    while (!stack.empty()) {
      const int f = stack.back();
      stack.pop_back();
      for (int c = 0; c < 3; ++c) {
        const int g = beside(c, f);
        if (faces(c, f) == v || g < 0) continue;
        if (std::find(seen.begin(), seen.end(), g) != seen.end()) continue;
        seen.push_back(g);
        stack.push_back(g);
      }
    }
    if (seen.size() != around[v].size())
      throw InputError(name + ": " + VertexName(v) +
                       " joins parts that share no edge (not a manifold)");
  }
}

}  // namespace

VertexFaces::VertexFaces(const Faces& faces, int num_vertices)
    : start_(num_vertices + 1, 0), face_(faces.size()) {
  for (Eigen::Index k = 0; k < faces.size(); ++k) ++start_[faces(k) + 1];
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  std::vector<int> next(start_.begin(), start_.end() - 1);
  for (int f = 0; f < faces.cols(); ++f)
    for (int c = 0; c < 3; ++c) face_[next[faces(c, f)]++] = f;
}

Faces FaceNeighbours(const Faces& faces) {
  Faces beside = Faces::Constant(3, faces.cols(), -1);
  const auto corner = [&](int f, int vertex) {
    return faces(0, f) == vertex ? 0 : faces(1, f) == vertex ? 1 : 2;
  };
  for (const Edge& e : Edges(faces)) {
    if (e.faces[1] < 0) continue;
    beside(corner(e.faces[0], e.opposite[0]), e.faces[0]) = e.faces[1];
    beside(corner(e.faces[1], e.opposite[1]), e.faces[1]) = e.faces[0];
  }
  return beside;
}

std::vector<std::vector<int>> BoundaryLoops(const Faces& faces) {
  const Faces beside = FaceNeighbours(faces);
  std::map<int, int> next;
  for (int f = 0; f < faces.cols(); ++f) {
    for (int c = 0; c < 3; ++c) {
      if (beside(c, f) >= 0) continue;
      const int from = faces((c + 1) % 3, f), to = faces((c + 2) % 3, f);
      if (!next.emplace(from, to).second)
        throw InputError(VertexName(from) + " lies on two boundaries");
    }
  }
  std::vector<std::vector<int>> loops;
  while (!next.empty()) {
    std::vector<int> loop;
    for (auto it = next.begin(); it != next.end();) {
      loop.push_back(it->first);
      const int to = it->second;
      next.erase(it);
      it = next.find(to);
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

std::vector<int> VertexComponents(const Faces& faces, int num_vertices) {
  std::vector<int> root(num_vertices);
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&root](int v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (int f = 0; f < faces.cols(); ++f) {
    for (int c = 1; c < 3; ++c) {
      const int a = find(faces(0, f)), b = find(faces(c, f));
      root[std::max(a, b)] = std::min(a, b);
    }
  }
  std::vector<int> number(num_vertices);
  int count = 0;
  for (int v = 0; v < num_vertices; ++v)
    number[v] = find(v) == v ? count++ : number[find(v)];
  return number;
}

int EulerCharacteristic(const Faces& faces) {
  std::vector<int> used(faces.data(), faces.data() + faces.size());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  return static_cast<int>(used.size()) - static_cast<int>(Edges(faces).size()) +
         static_cast<int>(faces.cols());
}

void ValidateMesh(const Points& vertices,
                  const Faces& faces,
                  const std::string& name) {
  if (faces.cols() == 0)
    throw InputError(name + ": no faces, expected a triangle mesh");
  CheckVertices(vertices, name);
  for (int f = 0; f < faces.cols(); ++f) CheckFace(vertices, faces, f, name);
  CheckFans(faces, static_cast<int>(vertices.cols()), name);
}

}  // namespace invsim
