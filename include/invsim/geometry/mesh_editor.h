// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_GEOMETRY_MESH_EDITOR_H_
#define INVSIM_GEOMETRY_MESH_EDITOR_H_

// A triangle mesh whose edges can be split, collapsed and flipped. Every
// operation keeps the mesh an oriented manifold (with or without boundary) of
// the same topology; an operation that would not is refused by its Can...
// question. Numbers of vertices and faces stay valid until `Compact`; removed
// ones leave holes in the numbering.

#include <array>
#include <span>
#include <vector>

#include "invsim/geometry/mesh.h"

namespace invsim {

class MeshEditor {
 public:
  // Throws InputError as Edges does.
  explicit MeshEditor(const TriangleMesh& mesh);

  // The mesh without the removed vertices and faces, in the order they had.
  TriangleMesh Compact() const;

  // Upper ends of the numbering, removed ones included.
  int num_vertices() const { return static_cast<int>(x_.size()); }
  int num_faces() const { return static_cast<int>(face_.size()); }
  bool HasVertex(int v) const { return !around_[v].empty(); }
  bool HasFace(int f) const { return face_[f][0] >= 0; }

  const Vector3d& position(int v) const { return x_[v]; }
  void set_position(int v, const Vector3d& x) { x_[v] = x; }
  const std::array<int, 3>& face(int f) const { return face_[f]; }
  std::span<const int> FacesAt(int v) const { return around_[v]; }
  bool OnBoundary(int v) const { return boundary_[v]; }
  // The vertices joined to v by an edge, ascending.
  std::vector<int> Neighbours(int v) const;
  // Every edge once, a < b, sorted.
  std::vector<std::array<int, 2>> EdgeList() const;

  // The two faces of edge (a, b) and the vertices opposite it; -1 for what is
  // not there (no such edge: both -1). faces[0] runs a -> b if it exists.
  struct EdgeFaces {
    int faces[2] = {-1, -1};
    int opposite[2] = {-1, -1};
    bool exists() const { return faces[0] >= 0 || faces[1] >= 0; }
    bool boundary() const { return (faces[0] >= 0) != (faces[1] >= 0); }
  };
  EdgeFaces FindEdge(int a, int b) const;

  // Twice the area times the normal of face f, with vertex `moved` taken to be
  // at `to` (moved < 0: none).
  Vector3d AreaVector(int f,
                      int moved = -1,
                      const Vector3d& to = Vector3d::Zero()) const;

  // Puts a vertex at `x` on edge (a, b), which must exist. Returns its number.
  int Split(int a, int b, const Vector3d& x);

  // Whether merging the ends of edge (a, b) leaves a manifold of the same
  // topology: the ends share no neighbours but the vertices opposite the edge
  // (the link condition), an inner edge does not join two boundary vertices,
  // and what remains is more than a single face or a tetrahedron.
  bool CanCollapse(int a, int b) const;
  // Merges b into a, placed at `x`.
  void Collapse(int a, int b, const Vector3d& x);

  // Whether the edge is inside and the other diagonal is not yet an edge.
  bool CanFlip(int a, int b) const;
  // Replaces edge (a, b) by the other diagonal of its two faces.
  void Flip(int a, int b);

 private:
  void RemoveFace(int f);
  void Replace(int f, int from, int to);

  std::vector<Vector3d> x_;
  std::vector<std::array<int, 3>> face_;  // {-1, ...} if removed
  std::vector<std::vector<int>> around_;  // faces at each vertex, ascending
  std::vector<char> boundary_;
};

}  // namespace invsim

#endif  // INVSIM_GEOMETRY_MESH_EDITOR_H_
