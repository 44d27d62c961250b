// SPDX-License-Identifier: Apache-2.0
#include "fuzz_target.h"
#include "invsim/io/obj.h"

namespace invsim {
namespace {

bool Same(const ObjMesh& a, const ObjMesh& b) {
  return a.vertices == b.vertices && a.faces == b.faces &&
         a.texture == b.texture && a.texture_faces == b.texture_faces;
}

void Read(std::string_view bytes) {
  const auto mesh = ReadOrRefuse([&] { return ParseObj(bytes, kFuzzName); });
  if (!mesh) return;
  Require(mesh->vertices.allFinite() && mesh->texture.allFinite(),
          "coordinates are finite");
  const std::string written = FormatObj(*mesh);
  Require(Same(MustRead([&] { return ParseObj(written, kFuzzName); }), *mesh),
          "a mesh written is read back as it was");
}

}  // namespace

const FuzzTarget kFuzzTarget = {Read};

}  // namespace invsim
