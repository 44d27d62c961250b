// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_TESTS_SIM_TEST_SCENE_H_
#define INVSIM_TESTS_SIM_TEST_SCENE_H_

// The smallest scene that dresses: a ball that follows the root joint, and a
// sheet lying just above it.

#include <memory>

#include "cloth/test_cloth.h"
#include "geometry/shapes.h"
#include "invsim/base/interrupt.h"
#include "invsim/body/body_model.h"
#include "invsim/cloth/garment.h"
#include "invsim/cloth/material.h"

namespace invsim {

inline constexpr double kBallRadius = 0.15;  // m

// The first shape direction swells the ball by a tenth; all else has no
// effect on it. Every joint but the root lies on a line above the centre.
inline BodyModel BallBody() {
  const TriangleMesh sphere = Sphere(2);
  const int n = static_cast<int>(sphere.vertices.cols());
  BodyModelData data;
  data.v_template = kBallRadius * sphere.vertices;
  data.shapedirs = VertexRows::Zero(3 * n, kNumShape);
  data.shapedirs.col(0) = 0.1 * Stacked(data.v_template);
  data.joint_regressor = MatrixXd::Zero(kNumJoints, n);
  data.joint_regressor.row(0).setConstant(1.0 / n);
  for (int j = 1; j < kNumJoints; ++j) data.joint_regressor(j, 2) = 1.0;
  data.weights = MatrixXd::Zero(n, kNumJoints);
  data.weights.col(0).setOnes();
  data.parents = {-1, 0, 0, 0,  1,  2,  3,  4,  5,  6,  7,  8,
                  9,  9, 9, 12, 13, 14, 16, 17, 18, 19, 20, 21};
  data.faces = sphere.faces;
  return BodyModel(data, "ball");
}

// A horizontal square sheet, `gap` above the ball.
inline Garment SheetAboveBall(int cells, double size, double gap = 0.005) {
  Garment sheet = Sheet(cells, cells, size / cells);
  for (int i = 0; i < sheet.num_vertices(); ++i) {
    const Vector2d p = sheet.rest.col(i).array() - 0.5 * size;
    sheet.placed.col(i) = Vector3d(p.x(), kBallRadius + gap, -p.y());
  }
  return sheet;
}

inline Material PlainCloth() {
  return {"plain", 0.2, IsotropicStretch{200.0, 0.3}, IsotropicBending{1e-5}};
}

// For a test that raises an interrupt: lowers it afterwards for the next test.
class InterruptedTest {
 public:
  ~InterruptedTest() {
    guard_.reset();
    const InterruptGuard lowered;
  }

 private:
  std::unique_ptr<InterruptGuard> guard_ = std::make_unique<InterruptGuard>();
};

}  // namespace invsim

#endif  // INVSIM_TESTS_SIM_TEST_SCENE_H_
