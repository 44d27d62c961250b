// SPDX-License-Identifier: Apache-2.0
#include "fuzz_target.h"
#include "invsim/io/ply.h"

namespace invsim {
namespace {

void CheckFaces(const PlyMesh& mesh) {
  if (mesh.faces.cols() == 0) return;
  Require(mesh.faces.minCoeff() >= 0,
          "no face names a vertex before the first");
  Require(mesh.faces.maxCoeff() < mesh.vertices.cols(),
          "no face names a vertex beyond the last");
}

// A text file may give a float more digits than 32 bits hold: what is written
// once is rounded, what is written again is the same.
void ReadAndWrite(std::string_view bytes) {
  const PlyReadOptions options = {.allow_non_finite = true};
  const auto mesh =
      ReadOrRefuse([&] { return ParsePly(bytes, kFuzzName, options); });
  if (!mesh) return;
  CheckFaces(*mesh);
  const std::string written = FormatPly(*mesh);
  const PlyMesh again =
      MustRead([&] { return ParsePly(written, kFuzzName, options); });
  Require(again.vertices.cols() == mesh->vertices.cols(), "as many vertices");
  Require(again.faces == mesh->faces, "the same faces");
  Require(again.properties.size() == mesh->properties.size(),
          "as many properties");
  Require(FormatPly(again) == written, "written again as the same bytes");
}

void Read(std::string_view bytes) {
  ReadAndWrite(bytes);
  const auto finite = ReadOrRefuse([&] { return ParsePly(bytes, kFuzzName); });
  if (!finite) return;
  Require(finite->vertices.allFinite(), "vertices are finite");
  const std::string written = FormatPly(*finite);
  MustRead([&] { return ParsePly(written, kFuzzName); });
}

}  // namespace

const FuzzTarget kFuzzTarget = {Read};

}  // namespace invsim
