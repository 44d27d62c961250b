// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_IO_OBJ_H_
#define INVSIM_IO_OBJ_H_

// Wavefront OBJ meshes: `v x y z`, `vt u v` and faces `f v`, `f v/vt`, `f
// v//vn`, `f v/vt/vn`, with indices from 1, or negative from the last one
// read. Further numbers of a `v` (weight, colour) or `vt` line, normals,
// groups, materials and statements of other programs are passed over.
//
// Vertices are never reordered, merged or dropped. A face of n > 3 corners is
// cut into the fan (0, k, k + 1), k = 1 .. n - 2, round its first corner,
// which is right for convex flat polygons.

#include <string>
#include <string_view>

#include "invsim/base/types.h"

namespace invsim {

struct ObjMesh {
  Points vertices;      // 3 x N, in the file's unit
  Faces faces;          // 3 x F into `vertices`, possibly none
  Points2 texture;      // 2 x R, the file's `vt`, possibly none
  Faces texture_faces;  // 3 x F into `texture`; empty if faces name no vt
};

// Throws InputError naming file, line and value: not a number, not finite, an
// index out of range, a face of fewer than three corners, vt on some corners
// only, no vertex at all, not an OBJ file.
ObjMesh ParseObj(std::string_view bytes, const std::string& name);
ObjMesh ReadObj(const std::string& path);

// Text with the shortest digits that read back as the same doubles. The file
// appears complete or not at all. Throws InputError if it cannot be written.
std::string FormatObj(const ObjMesh& mesh);
void WriteObj(const std::string& path, const ObjMesh& mesh);

}  // namespace invsim

#endif  // INVSIM_IO_OBJ_H_
