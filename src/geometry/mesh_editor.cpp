// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/mesh_editor.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace invsim {
namespace {

void Insert(std::vector<int>* sorted, int value) {
  sorted->insert(std::lower_bound(sorted->begin(), sorted->end(), value),
                 value);
}

void Erase(std::vector<int>* sorted, int value) {
  sorted->erase(std::lower_bound(sorted->begin(), sorted->end(), value));
}

}  // namespace

MeshEditor::MeshEditor(const TriangleMesh& mesh)
    : x_(mesh.vertices.cols()),
      face_(mesh.faces.cols()),
      around_(mesh.vertices.cols()),
      boundary_(mesh.vertices.cols(), 0) {
  for (int v = 0; v < num_vertices(); ++v) x_[v] = mesh.vertices.col(v);
  for (int f = 0; f < num_faces(); ++f) {
    for (int c = 0; c < 3; ++c) {
      face_[f][c] = mesh.faces(c, f);
      around_[face_[f][c]].push_back(f);
    }
  }
  for (const Edge& e : Edges(mesh.faces))
    if (e.faces[1] < 0) boundary_[e.a] = boundary_[e.b] = 1;
}

TriangleMesh MeshEditor::Compact() const {
  std::vector<int> number(num_vertices(), -1);
  int vertices = 0, faces = 0;
  for (int v = 0; v < num_vertices(); ++v)
    if (HasVertex(v)) number[v] = vertices++;
  for (int f = 0; f < num_faces(); ++f) faces += HasFace(f) ? 1 : 0;
  TriangleMesh mesh{Points(3, vertices), Faces(3, faces)};
  for (int v = 0; v < num_vertices(); ++v)
    if (HasVertex(v)) mesh.vertices.col(number[v]) = x_[v];
  for (int f = 0, k = 0; f < num_faces(); ++f) {
    if (!HasFace(f)) continue;
    for (int c = 0; c < 3; ++c) mesh.faces(c, k) = number[face_[f][c]];
    ++k;
  }
  return mesh;
}

std::vector<int> MeshEditor::Neighbours(int v) const {
  std::vector<int> r;
  for (const int f : around_[v])
    for (const int w : face_[f])
      if (w != v) r.push_back(w);
  std::sort(r.begin(), r.end());
  r.erase(std::unique(r.begin(), r.end()), r.end());
  return r;
}

std::vector<std::array<int, 2>> MeshEditor::EdgeList() const {
  std::vector<std::array<int, 2>> edges;
  for (int v = 0; v < num_vertices(); ++v)
    for (const int w : Neighbours(v))
      if (v < w) edges.push_back({v, w});
  return edges;
}

MeshEditor::EdgeFaces MeshEditor::FindEdge(int a, int b) const {
  EdgeFaces r;
  for (const int f : around_[a]) {
    for (int c = 0; c < 3; ++c) {
      if (face_[f][c] != a) continue;
      const int next = face_[f][(c + 1) % 3], last = face_[f][(c + 2) % 3];
      if (next == b) r.faces[0] = f, r.opposite[0] = last;
      if (last == b) r.faces[1] = f, r.opposite[1] = next;
    }
  }
  return r;
}

Vector3d MeshEditor::AreaVector(int f, int moved, const Vector3d& to) const {
  Vector3d p[3];
  for (int c = 0; c < 3; ++c)
    p[c] = face_[f][c] == moved ? to : x_[face_[f][c]];
  return (p[1] - p[0]).cross(p[2] - p[0]);
}

void MeshEditor::Replace(int f, int from, int to) {
  std::replace(face_[f].begin(), face_[f].end(), from, to);
  Erase(&around_[from], f);
  Insert(&around_[to], f);
}

void MeshEditor::RemoveFace(int f) {
  for (const int v : face_[f]) Erase(&around_[v], f);
  face_[f].fill(-1);
}

int MeshEditor::Split(int a, int b, const Vector3d& x) {
  const EdgeFaces e = FindEdge(a, b);
  const int m = num_vertices();
  x_.push_back(x);
  around_.emplace_back();
  boundary_.push_back(e.boundary());
  for (const int f : e.faces) {
    if (f < 0) continue;
    // The face keeps a and gets m for b; a copy of it gets m for a.
    const int copy = num_faces();
    face_.push_back(face_[f]);
    for (const int v : face_[copy]) Insert(&around_[v], copy);
    Replace(f, b, m);
    Replace(copy, a, m);
  }
  return m;
}

bool MeshEditor::CanCollapse(int a, int b) const {
  const EdgeFaces e = FindEdge(a, b);
  if (!e.exists()) return false;
  if (!e.boundary() && boundary_[a] && boundary_[b]) return false;
  const std::vector<int> of_a = Neighbours(a), of_b = Neighbours(b);
  std::vector<int> shared;
  std::set_intersection(of_a.begin(),
                        of_a.end(),
                        of_b.begin(),
                        of_b.end(),
                        std::back_inserter(shared));
  if (shared.size() != (e.boundary() ? 1u : 2u)) return false;
  // The opposite vertices lose a face each and must keep enough of them.
  for (const int v : shared)
    if (around_[v].size() < (boundary_[v] ? 2u : 4u)) return false;
  return true;
}

void MeshEditor::Collapse(int a, int b, const Vector3d& x) {
  const EdgeFaces e = FindEdge(a, b);
  for (const int f : e.faces)
    if (f >= 0) RemoveFace(f);
  const std::vector<int> faces = around_[b];
  for (const int f : faces) Replace(f, b, a);
  boundary_[a] = boundary_[a] || boundary_[b];
  x_[a] = x;
}

bool MeshEditor::CanFlip(int a, int b) const {
  const EdgeFaces e = FindEdge(a, b);
  return e.faces[0] >= 0 && e.faces[1] >= 0 &&
         !FindEdge(e.opposite[0], e.opposite[1]).exists();
}

void MeshEditor::Flip(int a, int b) {
  const EdgeFaces e = FindEdge(a, b);
  // faces[0] = (a, b, c), faces[1] = (b, a, d) become (a, d, c), (b, c, d).
  Replace(e.faces[0], b, e.opposite[1]);
  Replace(e.faces[1], a, e.opposite[0]);
}

}  // namespace invsim
