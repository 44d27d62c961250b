// SPDX-License-Identifier: Apache-2.0
#include "invsim/body/mannequin.h"

#include "mannequin_mesh.h"
#include "mannequin_shape.h"
#include "mannequin_skin.h"

namespace invsim {

const std::array<MannequinShapeInfo, kNumShape> kMannequinShapes = {{
    {"height", "all of the body 4 % larger"},
    {"weight", "all girths larger, the belly most"},
    {"shoulders", "each shoulder 1.2 cm further out"},
    {"hips", "each hip 1.1 cm further out, fuller buttocks"},
    {"limbs", "arms 2.2 cm and legs 3 cm longer"},
    {"chest", "a wider, deeper chest"},
    {"belly", "a rounder belly and waist"},
    {"arms", "arms 10 % thicker"},
    {"legs", "legs 8 % thicker"},
    {"head", "a head 3 % larger on a neck 6 % thicker"},
}};

namespace {

VertexRows ShapeDirections(const Points& vertices) {
  VertexRows directions(3 * vertices.cols(), kNumShape);
  for (Eigen::Index i = 0; i < vertices.cols(); ++i) {
    for (int k = 0; k < kNumShape; ++k) {
      directions.block<3, 1>(3 * i, k) = MannequinShapeDisplacement(
          static_cast<MannequinShape>(k), vertices.col(i));
    }
  }
  return directions;
}

BodyModel MakeMannequin() {
  const MirrorMesh body = MakeMannequinMesh();
  BodyModelData data;
  data.v_template = body.mesh.vertices;
  data.shapedirs = ShapeDirections(body.mesh.vertices);
  data.joint_regressor = MannequinRegressor(body);
  data.weights = MannequinWeights(body);
  data.parents = MannequinParents();
  data.faces = body.mesh.faces;
  return BodyModel(std::move(data), "mannequin");
}

}  // namespace

const BodyModel& Mannequin() {
  static const BodyModel body = MakeMannequin();
  return body;
}

}  // namespace invsim
