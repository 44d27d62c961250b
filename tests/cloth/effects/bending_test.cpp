// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/effects/bending.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>

#include "../test_cloth.h"
#include "invsim/cloth/effects/gravity.h"
#include "invsim/cloth/mass.h"
#include "invsim/geometry/mesh.h"

namespace invsim {
namespace {

constexpr double kRigidity = 1e-5;  // N m

// The pattern rolled onto a cylinder whose axis makes `turn` with axis 2.
Points Rolled(const Points2& rest, double curvature, double turn) {
  const Vector2d across(std::cos(turn), std::sin(turn));
  const Vector2d along(-std::sin(turn), std::cos(turn));
  Points x(3, rest.cols());
  for (int i = 0; i < rest.cols(); ++i) {
    const double angle = curvature * across.dot(rest.col(i));
    x.col(i) = Vector3d(std::sin(angle) / curvature,
                        along.dot(rest.col(i)),
                        (std::cos(angle) - 1.0) / curvature);
  }
  return x;
}

double EnergyOf(const Bending& bending, const Points& x) {
  return bending.Energy({x, Points::Zero(3, x.cols())});
}

// Only the edges along the axis bend, each by exactly its share; those of the
// last column are border, so that the whole converges with the mesh.
TEST(Bending, CylinderHasTheEnergyOfThePlate) {
  const double radius = 0.1, width = 0.12, height = 0.04;
  const double plate = 0.5 * kRigidity / (radius * radius) * width * height;
  for (const int n : {6, 12, 24, 48}) {
    const Garment garment = Sheet(n, n / 3, width / n);
    const Bending bending(garment, IsotropicBending{kRigidity});
    const double energy =
        EnergyOf(bending, Rolled(garment.rest, 1.0 / radius, 0.0));
    EXPECT_NEAR(energy, plate * (n - 1) / n, 1e-12 * plate);
  }
}

// Of equilateral triangles the sheet is equally stiff in every direction. The
// three edges of a face in the middle stand for the mesh.
TEST(Bending, EquilateralMeshIsIsotropic) {
  const double edge = 0.01, curvature = 1.0;
  Garment garment = TriangleSheet(4, 4, edge);
  const std::vector<Edge> edges = Edges(garment.faces);
  const Vector2d middle = garment.rest.rowwise().mean();
  garment.rest.colwise() -= middle;
  // A face and its three neighbours.
  Garment patch = garment;
  const int centre = 2 * (2 * 4 + 1);
  Eigen::Vector4i faces(centre, -1, -1, -1);
  int count = 1;
  for (const Edge& e : edges)
    for (int side = 0; side < 2; ++side)
      if (e.faces[side] == centre) faces[count++] = e.faces[1 - side];
  ASSERT_EQ(count, 4);
  patch.faces = garment.faces(Eigen::all, faces);
  patch.rest_faces = patch.faces;
  const Bending bending(patch, IsotropicBending{kRigidity});
  const double area = 2.0 * edge * edge * std::sqrt(3.0) / 4.0;
  const double plate = 0.5 * kRigidity * curvature * curvature * area;
  for (double turn = 0.0; turn < 3.2; turn += 0.2)
    EXPECT_NEAR(EnergyOf(bending, Rolled(garment.rest, curvature, turn)),
                plate,
                1e-4 * plate);
}

TEST(Bending, RestAnglesComeFromThePlacedShapeIfAsked) {
  Garment garment = Sheet(6, 2, 0.02);
  garment.placed = Rolled(garment.rest, 10.0, 0.3);
  const Bending flat(garment, IsotropicBending{kRigidity});
  EXPECT_GT(EnergyOf(flat, garment.placed), 1e-7);
  garment.rest_angles_from_placed = true;
  const Bending shaped(garment, IsotropicBending{kRigidity});
  EXPECT_EQ(EnergyOf(shaped, garment.placed), 0.0);
  const Points zero = Points::Zero(3, garment.num_vertices());
  EXPECT_LE(ForceOf(shaped, {garment.placed, zero}).norm(), 1e-15);
}

TEST(Bending, RestAnglesEnterForceAndTangent) {
  Garment garment = Sheet(3, 2, 0.02, 0.2);
  garment.placed = Rolled(garment.rest, 40.0, 0.3);
  garment.rest_angles_from_placed = true;
  Bending bending(garment, ExampleBendingTable());
  const auto pattern = BindAlone(&bending, garment.num_vertices());
  const Points x = 1.02 * garment.placed + RandomPoints(12, 2e-3, 3);
  const MatrixXd slope = Jacobian(
      [&](const Points& p) {
        return VectorXd::Constant(1, EnergyOf(bending, p));
      },
      x,
      1e-6);
  const VectorXd force = Stacked(ForceOf(bending, {x, x}));
  EXPECT_LE((slope.transpose() + force).norm(), 1e-7 * force.norm());
  BlockMatrix h(pattern);
  h.SetZero();
  const Points zero = Points::Zero(3, 12);
  bending.AddTangent({x, zero}, zero, zero, 1.0, &h, &h);
  const MatrixXd expected = Jacobian(
      [&](const Points& p) -> VectorXd {
        return -Stacked(ForceOf(bending, {p, zero}));
      },
      x,
      1e-7);
  EXPECT_LE((Dense(h) - expected).norm(), 1e-7 * expected.norm());
}

// A fold pressed until a face is a line: the gradient of its angle is bounded
// there, the turning of the angle is not.
TEST(Bending, TangentIsExactWhereAFaceHasCollapsed) {
  const Garment garment = Sheet(2, 2, 0.02);
  Bending bending(garment, ExampleBendingTable());
  const auto pattern = BindAlone(&bending, garment.num_vertices());
  Points x = garment.placed + RandomPoints(9, 4e-3, 4);
  x.col(1) = 0.5 * (x.col(0) + x.col(4)) + Vector3d(1e-5, 4e-5, -2e-5);
  const Points dx = RandomPoints(9, 1e-3, 5), zero = Points::Zero(3, 9);
  BlockMatrix h(pattern);
  h.SetZero();
  bending.AddTangent({x, zero}, dx, zero, 1.0, &h, &h);
  const MatrixXd expected = Jacobian(
      [&](const Points& p) -> VectorXd {
        const ClothState y{p, zero};
        return StiffnessOf(bending, pattern, y, 1.0, 0.0) *
                   VectorXd(Stacked(dx)) -
               VectorXd(Stacked(ForceOf(bending, y)));
      },
      x,
      1e-9);
  EXPECT_LE((Dense(h) - expected).norm(), 1e-5 * expected.norm());
}

// A sheet cut in two whose panels lie apart and turned in the pattern: sewn
// together again an isotropic sheet does not feel it, a measured one sees the
// direction of either side.
TEST(Bending, SeamsAreHinges) {
  const Garment whole = Sheet(2, 1, 0.02);
  Garment cut = whole;
  cut.rest.resize(2, 8);
  // Left panel: vertices 0, 1, 3, 4 as they were. Right panel: 1, 2, 4, 5
  // turned by a right angle.
  const int left[4] = {0, 1, 3, 4}, right[4] = {1, 2, 4, 5};
  for (int i = 0; i < 4; ++i) {
    cut.rest.col(i) = whole.rest.col(left[i]);
    const Vector2d p = whole.rest.col(right[i]);
    cut.rest.col(4 + i) = Vector2d(1.0 - p.y(), p.x());
  }
  for (int f = 0; f < whole.num_faces(); ++f)
    for (int c = 0; c < 3; ++c) {
      const int* panel = f < 2 ? left : right;
      const int v = whole.faces(c, f);
      cut.rest_faces(c, f) =
          (f < 2 ? 0 : 4) +
          static_cast<int>(std::find(panel, panel + 4, v) - panel);
    }
  const Points x = Rolled(whole.rest, 10.0, 0.0);
  const IsotropicBending isotropic{kRigidity};
  EXPECT_NEAR(EnergyOf(Bending(cut, isotropic), x),
              EnergyOf(Bending(whole, isotropic), x),
              1e-15);
  MeasuredBending fabric{};
  fabric.table[0].fill(1e-5);  // edges along axis 1, as the seam on the right
  fabric.table[2].fill(4e-5);  // along axis 2, as the seam on the left
  const double stiff = EnergyOf(Bending(whole, fabric), x);
  EXPECT_NEAR(EnergyOf(Bending(cut, fabric), x), stiff / 4.0, 1e-3 * stiff);
}

// Heights at rest under `load` (N/m^2) of a strip along x whose vertices up to
// 1.5 `cell` are held. The heights of the others are `span` times the unknowns:
// a way to tie them together.
VectorXd SagOf(const Garment& garment,
               double cell,
               double load,
               const MatrixXd& span) {
  const Material material{"strip",
                          load / 9.8,
                          IsotropicStretch{100.0},
                          IsotropicBending{kRigidity}};
  Bending bending(garment, material.bending);
  const Gravity gravity(VertexMasses(garment, material),
                        {.acceleration = Vector3d(0, 0, -9.8)});
  const auto pattern = BindAlone(&bending, garment.num_vertices());
  const Eigen::VectorXi free = Where(3 * garment.num_vertices(), [&](int k) {
    return k % 3 == 2 && garment.rest(0, k / 3) > 1.5 * cell;
  });
  const Points zero = Points::Zero(3, garment.num_vertices());
  ClothState state{garment.placed, zero};
  for (int iteration = 0; iteration < 5; ++iteration) {
    BlockMatrix h(pattern), unused(pattern);
    h.SetZero();
    bending.AddTangent(state, zero, zero, 1.0, &h, &unused);
    const Points force = ForceOf(bending, state) + ForceOf(gravity, state);
    const MatrixXd k = span.transpose() * Dense(h)(free, free) * span;
    const VectorXd step = k.lu().solve(span.transpose() * Stacked(force)(free));
    Stacked(state.x)(free) += span * step;
  }
  const Points force = ForceOf(bending, state) + ForceOf(gravity, state);
  EXPECT_LE((span.transpose() * Stacked(force)(free)).norm(), 1e-12);
  return state.x.row(2);
}

// A wide strip held at one end, bent into a cylinder (both edges of a column
// tied), sags by q L^4 / (8 B) under its own weight, the deflection being
// small. Two columns are held: the clamp is half a cell before the second,
// where the first hinge begins.
TEST(Bending, CantileverSagsLikeAPlate) {
  const int n = 30;
  const double cell = 0.01, length = (n - 0.5) * cell, sag = 0.01 * length;
  const double load = sag * 8.0 * kRigidity / std::pow(length, 4);
  MatrixXd tied(2 * (n - 1), n - 1);
  tied << MatrixXd::Identity(n - 1, n - 1), MatrixXd::Identity(n - 1, n - 1);
  const VectorXd heights = SagOf(Sheet(n, 1, cell), cell, load, tied);
  EXPECT_NEAR(-heights[n], sag, 0.005 * sag);
}

// A narrow strip is free to curl across as well. A sheet of equilateral hinges
// has a Poisson's ratio of -1/3 in bending, so it sags as a beam of stiffness
// (1 - 1/9) B.
TEST(Bending, CantileverSagsLikeABeamIfItMayCurl) {
  const int nx = 60, ny = 4;
  const double cell = 0.01;
  const Garment garment = TriangleSheet(nx, ny, cell);
  const double length = nx * cell - 1.25 * cell, sag = 0.01 * length;
  const double load = sag * 8.0 * kRigidity * 8.0 / 9.0 / std::pow(length, 4);
  int free = 0;
  for (int i = 0; i < garment.num_vertices(); ++i)
    free += garment.rest(0, i) > 1.5 * cell;
  const VectorXd heights =
      SagOf(garment, cell, load, MatrixXd::Identity(free, free));
  EXPECT_NEAR(-heights[2 * (nx + 1) + nx], sag, 0.03 * sag);
}

TEST(Bending, SurvivesSliversAndFolds) {
  const Garment garment = Sheet(2, 2, 0.02);
  Bending bending(garment, ExampleBendingTable());
  const auto pattern = BindAlone(&bending, garment.num_vertices());
  Points flat = garment.placed;
  flat.row(0).setZero();  // every face is a line
  for (const Points& x : {flat, Points(Points::Zero(3, 9))}) {
    EXPECT_TRUE(ForceOf(bending, {x, x}).allFinite());
    EXPECT_TRUE(StiffnessOf(bending, pattern, {x, x}, 1.0, 0.0).allFinite());
    BlockMatrix h(pattern);
    h.SetZero();
    bending.AddTangent({x, x}, flat, flat, 1.0, &h, &h);
    EXPECT_TRUE(Dense(h).allFinite());
  }
}

}  // namespace
}  // namespace invsim
