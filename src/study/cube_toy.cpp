// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/cube_toy.h"

#include <utility>

#include "invsim/base/error.h"
#include "invsim/cloth/named_materials.h"
#include "invsim/sim/sensitivity.h"

namespace invsim {
namespace {

constexpr double kHalfEdge = 0.15;       // m
constexpr double kSheet = 0.45;          // m
constexpr double kFallHeight = 0.08;     // m, over the corner of a tilted cube
constexpr double kFramesPerSecond = 60;  // of the fall
constexpr int kTiltParameter = kNumShape + 2;  // the root about z

}  // namespace

BodyModel CubeBody() {
  Points corners(3, 8);
  for (int k = 0; k < 8; ++k)
    corners.col(k) << (k & 1 ? 1 : -1), (k & 2 ? 1 : -1), (k & 4 ? 1 : -1);
  BodyModelData data;
  data.v_template = kHalfEdge * corners;
  data.faces.resize(3, 12);
  data.faces << 0, 0, 1, 1, 0, 0, 2, 2, 0, 0, 4, 4,  //
      4, 6, 3, 7, 1, 5, 6, 7, 2, 3, 5, 7,            //
      6, 2, 7, 5, 5, 4, 7, 3, 3, 1, 7, 6;
  data.shapedirs = VertexRows::Zero(24, kNumShape);
  // The root in the middle; the others, without influence, at a corner.
  data.joint_regressor = MatrixXd::Zero(kNumJoints, 8);
  data.joint_regressor.row(0).setConstant(1.0 / 8);
  data.joint_regressor.bottomRows(kNumJoints - 1).col(0).setOnes();
  data.weights = MatrixXd::Zero(8, kNumJoints);
  data.weights.col(0).setOnes();
  data.parents = {-1, 0, 0, 0,  1,  2,  3,  4,  5,  6,  7,  8,
                  9,  9, 9, 12, 13, 14, 16, 17, 18, 19, 20, 21};
  return BodyModel(std::move(data), "cube");
}

Garment SheetAbove(const Points& points, int cells, double gap) {
  const int n = cells + 1;
  const double cell = kSheet / cells;
  Eigen::Index top;
  const double height = points.row(1).maxCoeff(&top) + gap;
  const Vector3d middle = points.rowwise().mean();
  Garment sheet;
  sheet.rest.resize(2, n * n);
  sheet.placed.resize(3, n * n);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const Vector2d p(i * cell - 0.5 * kSheet, j * cell - 0.5 * kSheet);
      sheet.rest.col(j * n + i) = p;
      sheet.placed.col(j * n + i) << middle.x() + p.x(), height,
          middle.z() - p.y();
    }
  sheet.faces.resize(3, 2 * cells * cells);
  int f = 0;
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const int a = j * n + i, b = a + 1, c = a + n, d = c + 1;
      const bool even = (i + j) % 2 == 0;
      sheet.faces.col(f++) << a, b, (even ? d : c);
      sheet.faces.col(f++) << (even ? a : b), d, c;
    }
  sheet.rest_faces = sheet.faces;
  return sheet;
}

CubeToy::CubeToy(const SceneOptions& scene, int cells, int frames)
    : cube_(CubeBody()),
      sheet_(SheetAbove(cube_.Vertices({}), cells, kFallHeight)),
      simulator_(MakeSetup(scene, cube_, sheet_, FindMaterial(scene.material))),
      frames_(frames) {
  target_ = Run(0).cloth;
}

CubeToy::Fall CubeToy::Run(double tilt) {
  BodyParameters parameters;
  parameters.pose[2] = tilt;
  const Points body = cube_.Vertices(parameters);
  const std::shared_ptr<const PosedBody> posed = cube_.Pose(parameters);
  const Eigen::Index n = sheet_.num_vertices();
  ClothState state{sheet_.placed, Points::Zero(3, n)};
  StateColumns slope{Columns::Zero(3 * n, 1), Columns::Zero(3 * n, 1)};
  simulator_.FindInside(body, state);
  Sensitivity sensitivity(simulator_);
  Fall fall;
  for (int k = 0; k < frames_ && fall.usable; ++k) {
    FrameRecord record;
    StepStats stats;
    fall.usable = simulator_.Advance(
        body, body, 1 / kFramesPerSecond, &state, &stats, &record);
    if (!fall.usable) break;
    const std::vector<int> vertices =
        Sensitivity::BodyVertices(simulator_.body_faces(), record);
    const Columns turn = posed->Jacobian(vertices).col(kTiltParameter);
    StateColumns end;
    fall.usable =
        sensitivity.Forward(record, vertices, turn, turn, &slope, &end);
    slope = std::move(end);
  }
  fall.cloth = state.x;
  fall.slope = Eigen::Map<const Points>(slope.x.data(), 3, n);
  return fall;
}

CubeToy::Loss CubeToy::Evaluate(double tilt) {
  const Fall fall = Run(tilt);
  if (!fall.usable)
    throw InputError("cube: the fall at this tilt cannot be differentiated");
  const Points off = fall.cloth - target_;
  const double n = static_cast<double>(off.cols());
  return {off.squaredNorm() / n, 2 / n * off.cwiseProduct(fall.slope).sum()};
}

}  // namespace invsim
