// SPDX-License-Identifier: Apache-2.0
#include "invsim/body/mannequin.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "invsim/geometry/mesh.h"
#include "invsim/geometry/remesh.h"
#include "invsim/geometry/topology.h"

namespace invsim {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

double Volume(const Points& v, const Faces& f) {
  double six = 0.0;
  for (Eigen::Index k = 0; k < f.cols(); ++k) {
    const Vector3d a = v.col(f(0, k));
    const Vector3d b = v.col(f(1, k));
    six += a.cross(b).dot(v.col(f(2, k)));
  }
  return six / 6.0;
}

double Height(const Points& v) {
  return v.row(1).maxCoeff() - v.row(1).minCoeff();
}

TEST(Mannequin, IsOneClosedSurfaceOfGoodTriangles) {
  const BodyModel& body = Mannequin();
  const Points rest = body.Vertices({});
  EXPECT_GE(body.num_vertices(), 2000);
  EXPECT_LE(body.num_vertices(), 4000);
  ValidateMesh(rest, body.faces(), "mannequin");
  EXPECT_TRUE(BoundaryLoops(body.faces()).empty());
  EXPECT_EQ(EulerCharacteristic(body.faces()), 2);
  const std::vector<int> piece =
      VertexComponents(body.faces(), body.num_vertices());
  EXPECT_EQ(*std::max_element(piece.begin(), piece.end()), 0);
  EXPECT_GT(SmallestAngles(rest, body.faces()).minCoeff(), 18 * kDegree);
}

TEST(Mannequin, HasTheSizeOfAPerson) {
  const BodyModel& body = Mannequin();
  const Points rest = body.Vertices({});
  EXPECT_NEAR(Height(rest), 1.70, 0.01);
  EXPECT_NEAR(rest.row(1).minCoeff(), -1.10, 0.01);
  // Positive: faces look outward. About the volume in litres is the mass in kg.
  EXPECT_GT(Volume(rest, body.faces()), 0.055);
  EXPECT_LT(Volume(rest, body.faces()), 0.075);
}

TEST(Mannequin, IsItsOwnMirrorImage) {
  const Points& rest = Mannequin().data().v_template;
  std::set<std::array<double, 3>> places;
  for (Eigen::Index i = 0; i < rest.cols(); ++i) {
    places.insert({rest(0, i), rest(1, i), rest(2, i)});
  }
  for (const auto& [x, y, z] : places) {
    EXPECT_TRUE(places.count({-x + 0.0, y, z})) << x << " " << y << " " << z;
  }
}

TEST(Mannequin, ShapesStayWellShaped) {
  const BodyModel& body = Mannequin();
  for (int k = 0; k < kNumShape; ++k) {
    for (const double beta : {-2.0, 2.0}) {
      BodyParameters p;
      p.shape[k] = beta;
      const Points v = body.Vertices(p);
      EXPECT_GT(SmallestAngles(v, body.faces()).minCoeff(), 15 * kDegree)
          << kMannequinShapes[k].name << " " << beta;
      EXPECT_GT(Volume(v, body.faces()), 0.04);
    }
  }
}

TEST(Mannequin, ShapesHaveNamesAndDifferentEffects) {
  std::set<std::string> names;
  for (const MannequinShapeInfo& info : kMannequinShapes) {
    names.insert(info.name);
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(kNumShape));
  // No direction is nearly a combination of the others.
  MatrixXd directions = Mannequin().data().shapedirs;
  directions.colwise().normalize();
  const Eigen::JacobiSVD<MatrixXd> svd(directions.transpose() * directions);
  EXPECT_GT(svd.singularValues().minCoeff(), 0.02);
}

class MannequinMeasures : public ::testing::Test {
 protected:
  // What one unit of a coefficient adds to a measure of the shaped body.
  template <typename Measure>
  double Change(MannequinShape shape, const Measure& measure) {
    BodyParameters p;
    p.shape[static_cast<int>(shape)] = 1.0;
    return measure(p) - measure({});
  }
  static double JointDistance(const BodyParameters& p, int a, int b) {
    const Points joints = Mannequin().Joints(p);
    return (joints.col(a) - joints.col(b)).norm();
  }
};

TEST_F(MannequinMeasures, ShapesDoWhatTheySay) {
  const auto height = [](const BodyParameters& p) {
    return Height(Mannequin().Vertices(p));
  };
  const auto volume = [](const BodyParameters& p) {
    return Volume(Mannequin().Vertices(p), Mannequin().faces());
  };
  const auto between = [](int a, int b) {
    return [a, b](const BodyParameters& p) { return JointDistance(p, a, b); };
  };
  EXPECT_NEAR(Change(MannequinShape::kHeight, height), 0.04 * 1.70, 1e-3);
  EXPECT_NEAR(Change(MannequinShape::kWeight, height), 0.0, 2e-3);
  EXPECT_GT(Change(MannequinShape::kWeight, volume), 0.004);
  EXPECT_NEAR(Change(MannequinShape::kShoulders, between(16, 17)), 0.024, 3e-3);
  EXPECT_GT(Change(MannequinShape::kHips, between(1, 2)), 0.01);
  EXPECT_NEAR(Change(MannequinShape::kLimbs, between(16, 20)), 0.022, 3e-3);
  EXPECT_NEAR(Change(MannequinShape::kLimbs, between(1, 7)), 0.030, 4e-3);
  EXPECT_GT(Change(MannequinShape::kChest, volume), 5e-4);
  EXPECT_GT(Change(MannequinShape::kBelly, volume), 1e-3);
  EXPECT_GT(Change(MannequinShape::kArms, volume), 3e-4);
  EXPECT_GT(Change(MannequinShape::kLegs, volume), 8e-4);
  EXPECT_GT(Change(MannequinShape::kHeadSize, height), 4e-3);
}

}  // namespace
}  // namespace invsim
