// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_GEOMETRY_TOPOLOGY_H_
#define INVSIM_GEOMETRY_TOPOLOGY_H_

// Who is next to whom in a triangle mesh: faces round a vertex, faces beside a
// face, boundary loops, pieces; and the check that a mesh is a manifold.

#include <span>
#include <string>
#include <vector>

#include "invsim/base/types.h"

namespace invsim {

// The faces at each vertex, ascending.
class VertexFaces {
 public:
  VertexFaces(const Faces& faces, int num_vertices);
  std::span<const int> operator[](int vertex) const {
    return {face_.data() + start_[vertex],
            static_cast<size_t>(start_[vertex + 1] - start_[vertex])};
  }

 private:
  std::vector<int> start_;
  std::vector<int> face_;
};

// 3 x F: entry (c, f) is the face across the side of f opposite its corner c,
// or -1 on a boundary. Throws InputError as `Edges` does.
Faces FaceNeighbours(const Faces& faces);

// The boundary as closed loops of vertices, each in the direction in which its
// faces run along it, starting from its smallest vertex; sorted by that
// vertex. Throws InputError naming the vertex where loops touch.
std::vector<std::vector<int>> BoundaryLoops(const Faces& faces);

// The piece of each vertex, numbered from 0 by smallest vertex: vertices joined
// by edges share one. A vertex without faces is a piece of its own.
std::vector<int> VertexComponents(const Faces& faces, int num_vertices);

// V - E + F over the vertices that have faces: 2 - 2 genus - loops for one
// piece.
int EulerCharacteristic(const Faces& faces);

// Throws InputError, `name` first, naming the vertex, edge or face, unless
//  - there is at least one face, coordinates are finite, faces refer to
//    existing vertices, and every vertex has a face,
//  - no face has a vertex twice or (nearly) no area: twice the area above
//    1e-10 of the longest side squared,
//  - at most two faces meet at an edge, and run along it opposite ways,
//  - the faces round a vertex form one fan.
// Numbers in messages count from 0.
void ValidateMesh(const Points& vertices,
                  const Faces& faces,
                  const std::string& name);

}  // namespace invsim

#endif  // INVSIM_GEOMETRY_TOPOLOGY_H_
