// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_IO_PLY_H_
#define INVSIM_IO_PLY_H_

// PLY point clouds and triangle meshes with any further numbers per vertex.
//
// Read: ascii, binary of either byte order, any number type; vertex x, y, z
// and every other scalar property of the vertices; faces from the list
// vertex_indices (or vertex_index), polygons cut into a fan round their first
// corner. Elements, face properties and lists we do not need are passed over.
// An ascii file has one row a line. Nothing is reordered, merged or dropped.
//
// Written: binary little-endian; properties under the names given, so that
// other programs find them: `red green blue` (uchar), `quality` (MeshLab's
// scalar), `nx ny nz`.

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "invsim/base/types.h"
#include "invsim/io/ply_header.h"

namespace invsim {

// One number per vertex.
struct PlyProperty {
  std::string name;
  VectorXd values;
  PlyType type = PlyType::kFloat32;  // in the file
};

struct PlyMesh {
  Points vertices;                      // 3 x N
  Faces faces;                          // 3 x F, possibly none
  std::vector<PlyProperty> properties;  // in the file's order, without x y z
  // Of x, y and z in the file; double where they differ.
  PlyType position_type = PlyType::kFloat32;

  // The values of a property; null if there is none of that name.
  const VectorXd* Find(std::string_view name) const;

  // For writing: one, three or colour numbers per vertex. Colours are given in
  // [0, 1] and written as uchar red, green, blue.
  void AddScalar(const std::string& name, const VectorXd& values);
  void AddVector(const std::array<std::string, 3>& names, const Points& values);
  void AddColors(const Points& colors);
};

struct PlyReadOptions {
  // Scanners mark missing points by NaN. If true they are kept as they are,
  // otherwise they are refused with their number and the first of them.
  bool allow_non_finite = false;
};

// Throws InputError naming file and place: not a PLY file, no vertex element
// with x, y and z, fewer bytes than the header promises (expected and actual),
// bytes left over, an index out of range, a face of fewer than three corners,
// non-finite positions.
PlyMesh ParsePly(std::string_view bytes,
                 const std::string& name,
                 const PlyReadOptions& options = {});
PlyMesh ReadPly(const std::string& path, const PlyReadOptions& options = {});

// Throws Error (internal) if the arrays do not fit together or two properties
// have one name; WritePly throws InputError if the file cannot be written.
std::string FormatPly(const PlyMesh& mesh);
void WritePly(const std::string& path, const PlyMesh& mesh);

}  // namespace invsim

#endif  // INVSIM_IO_PLY_H_
