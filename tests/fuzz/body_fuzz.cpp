// SPDX-License-Identifier: Apache-2.0
#include "fuzz_target.h"
#include "invsim/body/body_model.h"
#include "mend_zip.h"

namespace invsim {
namespace {

// Files hold 32 bits: what a float cannot hold is not written.
bool FitsFloats(const BodyModelData& data) {
  constexpr double kTame = 1e6;
  const auto tame = [](const auto& m) {
    return m.size() == 0 || m.cwiseAbs().maxCoeff() < kTame;
  };
  return tame(data.v_template) && tame(data.shapedirs) && tame(data.posedirs) &&
         tame(data.joint_regressor);
}

void Read(std::string_view bytes) {
  const auto body = ReadOrRefuse(
      [&] { return ParseBodyModel(std::string(bytes), kFuzzName); });
  if (!body) return;
  BodyParameters bent;
  bent.shape.setConstant(0.5);
  bent.pose.setConstant(0.1);
  const Points vertices = body->Vertices(bent);
  Require(vertices.cols() == body->num_vertices(), "all vertices are posed");
  if (!FitsFloats(body->data())) return;
  Require(vertices.allFinite(), "a posed body is finite");
  const BodyModel again = MustRead(
      [&] { return ParseBodyModel(FormatBodyModel(*body), kFuzzName); });
  Require(again.faces() == body->faces(), "the same faces");
  Require(again.data().parents == body->data().parents, "the same tree");
  Require(again.num_vertices() == body->num_vertices(), "as many vertices");
}

}  // namespace

const FuzzTarget kFuzzTarget = {Read, MendZip};

}  // namespace invsim
