// SPDX-License-Identifier: Apache-2.0
#include "../../src/sim/cloth_derivatives.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "cloth/test_cloth.h"

namespace invsim {
namespace {

constexpr double kSubstep = 0.005;

// Nine vertices; behind a contact with the body, which is none of its
// business, a vertex near a face, two edges near each other, and a vertex and a
// face that were found on their way.
class ClothDerivativesTest : public ::testing::Test {
 protected:
  ClothDerivativesTest() {
    sub_.dt = kSubstep;
    sub_.start.x.resize(3, 9);
    sub_.start.x << 0.001, -0.01, 0.012, 0, 0.03, 0.052, 0.041, 0.038, 0.02,  //
        0.0008, 0, 0, 1e-4, 0.0007, 0.0008, 0, 1e-4, 0.004,                   //
        0.002, -0.004, -0.005, 0.012, 0.001, -0.001, -0.011, 0.009, 0.003;
    sub_.contacts.resize(1);
    sub_.contacts[0].vertex[0] = 4;
    Add(PairFeature::kVertexFace, {0, 1, 2, 3});
    Add(PairFeature::kEdgeEdge, {4, 5, 6, 7});
    AddSwept({8, 6, 2, 3}, {1, -0.5, -0.2, -0.3});
    sub_.linearizations.resize(1);
    lin_ = &sub_.linearizations[0];
    lin_->v = Stacked(RandomPoints(9, 1, 5));
    const Points forces = RandomPoints(4, 1, 6);
    for (int k = 0; k < 4; ++k) lin_->forces.push_back(forces.col(k));
  }

  void Add(PairFeature feature, const std::array<int, 4>& vertex) {
    ClothContact source{
        static_cast<int>(sub_.contacts.size()), feature, vertex, 1, 0.001};
    sub_.cloth_sources.push_back(source);
    sub_.contacts.emplace_back();
    if (EvaluateClothPlane(options_, kSubstep, source, PairAt(vertex, sub_))
            .distance < 0)
      sub_.cloth_sources.back().side = -1;
    Update(&sub_);
  }
  void AddSwept(const std::array<int, 4>& vertex,
                const std::array<double, 4>& weight) {
    ClothContact source{static_cast<int>(sub_.contacts.size()),
                        PairFeature::kVertexFace,
                        vertex,
                        1,
                        0.001,
                        true};
    sub_.cloth_sources.push_back(source);
    Contact contact;
    contact.num_vertices = 4;
    contact.vertex = vertex;
    contact.weight = weight;
    contact.normal = Vector3d(0.6, 0.8, 0);
    sub_.contacts.push_back(contact);
    Update(&sub_);
  }
  static PairPoints PairAt(const std::array<int, 4>& vertex,
                           const SubstepRecord& sub) {
    PairPoints x;
    for (int k = 0; k < 4; ++k) x.col(k) = sub.start.x.col(vertex[k]);
    return x;
  }
  // What a step that starts at sub->start finds of the same pairs. Of a swept
  // one normal and weights stay; w = n min((h - n . sum_k w_k x_k) / dt, c).
  void Update(SubstepRecord* sub) const {
    for (const ClothContact& source : sub->cloth_sources) {
      Contact& c = sub->contacts[source.contact];
      const PairPoints x = PairAt(source.vertex, *sub);
      if (source.swept) {
        const double distance =
            c.normal.dot(c.Gather(Stacked(Points(sub->start.x))));
        c.velocity =
            c.normal * std::min((source.thickness - distance) / kSubstep,
                                options_.recovery_speed);
        continue;
      }
      const ClothPlane p = EvaluateClothPlane(options_, kSubstep, source, x);
      c.num_vertices = 4;
      c.vertex = source.vertex;
      c.normal = p.normal;
      c.velocity = p.velocity;
      for (int k = 0; k < 4; ++k) c.weight[k] = p.weights[k];
    }
  }
  // Normals, velocities and weights, stacked, if the start moves by `dx`.
  VectorXd PlanesAt(const VectorXd& dx) const {
    SubstepRecord moved = sub_;
    Stacked(moved.start.x) += dx;
    Update(&moved);
    VectorXd all(12 + 12 + 12);
    all.setZero();
    for (int k = 0; k < 4; ++k) {
      all.segment<3>(3 * k) = moved.contacts[k].normal;
      all.segment<3>(12 + 3 * k) = moved.contacts[k].velocity;
      for (int j = 0; k > 0 && j < 4; ++j)
        all[24 + 4 * (k - 1) + j] = moved.contacts[k].weight[j];
    }
    return all;
  }
  // The same as derived: a column for every column of x0.
  Columns Moves(const Columns& x0) const {
    const ClothDerivatives cloth(&options_, sub_);
    Columns dn = Columns::Zero(12, x0.cols()), dw = dn;
    const Columns weights = cloth.Forward(x0, &dn, &dw);
    Columns all(36, x0.cols());
    all << dn, dw, weights;
    return all;
  }

  // Fast enough that no gap is cut off, unless a test says so.
  SelfContactOptions options_ = {.recovery_speed = 100};
  SubstepRecord sub_;
  LinearizationRecord* lin_ = nullptr;
};

Columns RandomColumns(int rows, int cols, unsigned seed) {
  const Points p = RandomPoints((rows * cols + 2) / 3, 1, seed);
  Columns all(rows, cols);
  std::copy_n(p.data(), rows * cols, all.data());
  return all;
}

TEST_F(ClothDerivativesTest, ForwardMatchesDifferences) {
  for (const double recovery : {100.0, 0.01}) {
    options_.recovery_speed = recovery;
    Update(&sub_);
    const Columns moves = Moves(Columns::Identity(27, 27));
    for (int k = 0; k < 27; ++k) {
      const VectorXd differences = Derivative(
          [&](double s) { return PlanesAt(s * VectorXd::Unit(27, k)); }, 1e-6);
      EXPECT_LT((moves.col(k) - differences).norm(),
                1e-6 * (1 + differences.norm()))
          << k << ", recovery " << recovery;
    }
  }
}

// Of layers that part as fast as they may the gap does not matter.
TEST_F(ClothDerivativesTest, ACutOffGapOfASweptPairDoesNotMove) {
  options_.recovery_speed = 1e-3;
  sub_.start.x(1, 8) = -0.02;  // deep on the wrong side
  Update(&sub_);
  const Columns moves = Moves(Columns::Identity(27, 27));
  EXPECT_EQ(moves.middleRows(12 + 9, 3).norm(), 0);
}

// Where they all are together does not matter.
TEST_F(ClothDerivativesTest, AShiftOfEverythingMovesNothing) {
  const Columns shift = Vector3d(0.3, -0.5, 0.7).replicate(9, 1);
  EXPECT_LT(Moves(shift).norm(), 1e-9);
}

// The pairs turn with the cloth: dn = w x n, and so does the velocity. (Of a
// swept pair the normal stays as it is.)
TEST_F(ClothDerivativesTest, ATurnOfEverythingTurnsThePlanes) {
  const Vector3d turn(0.3, -0.5, 0.7);
  Points x0(3, 9);
  for (int i = 0; i < 9; ++i) x0.col(i) = turn.cross(sub_.start.x.col(i));
  const Columns moves = Moves(Stacked(x0));
  for (const int k : {1, 2}) {
    const Contact& c = sub_.contacts[k];
    EXPECT_LT((moves.middleRows(3 * k, 3) - turn.cross(c.normal)).norm(), 1e-9);
    EXPECT_LT((moves.middleRows(12 + 3 * k, 3) - turn.cross(c.velocity)).norm(),
              1e-9);
    EXPECT_LT(moves.middleRows(24 + 4 * (k - 1), 4).norm(), 1e-9);
  }
}

// The contact with the body is for others to differentiate.
TEST_F(ClothDerivativesTest, OtherContactsAreLeftAlone) {
  const ClothDerivatives cloth(&options_, sub_);
  Columns dn = Columns::Constant(12, 2, 7.0),
          dw = Columns::Constant(12, 2, 8.0);
  cloth.Forward(RandomColumns(27, 2, 1), &dn, &dw);
  EXPECT_EQ(dn.topRows(3), Columns::Constant(3, 2, 7.0));
  EXPECT_EQ(dw.topRows(3), Columns::Constant(3, 2, 8.0));
}

// The weights act in u = G v - w and in the force G^T r, as the contacts
// themselves gather and scatter.
TEST_F(ClothDerivativesTest, MovesOfWeightsActWhereTheWeightsDo) {
  const ClothDerivatives cloth(&options_, sub_);
  const Columns weights = RandomColumns(12, 1, 3);
  Columns dw = Columns::Zero(12, 1), m = Columns::Zero(27, 1);
  cloth.AddForward(*lin_, weights, &dw, &m);
  VectorXd expected_dw = VectorXd::Zero(12), expected_m = VectorXd::Zero(27);
  for (int k = 1; k < 4; ++k) {
    Contact moved = sub_.contacts[k];
    for (int j = 0; j < 4; ++j) moved.weight[j] = weights(4 * (k - 1) + j, 0);
    expected_dw.segment<3>(3 * k) -= moved.Gather(lin_->v);
    moved.Scatter(lin_->forces[k], &expected_m);
  }
  EXPECT_LT((dw - expected_dw).norm(), 1e-14);
  EXPECT_LT((m - expected_m).norm(), 1e-14);
}

TEST_F(ClothDerivativesTest, AdjointIsTheTranspose) {
  const ClothDerivatives cloth(&options_, sub_);
  const Columns x0 = RandomColumns(27, 3, 11);
  Columns dn = Columns::Zero(12, 3), dw = dn;
  const Columns weights = cloth.Forward(x0, &dn, &dw);
  const Columns an = RandomColumns(12, 3, 12), aw = RandomColumns(12, 3, 13),
                a_weights = RandomColumns(12, 3, 14);
  Columns a0 = Columns::Zero(27, 3);
  cloth.Adjoint(an, aw, a_weights, &a0);
  const double forward = dn.cwiseProduct(an).sum() + dw.cwiseProduct(aw).sum() +
                         weights.cwiseProduct(a_weights).sum();
  EXPECT_NEAR(x0.cwiseProduct(a0).sum(), forward, 1e-10 * std::abs(forward));
}

TEST_F(ClothDerivativesTest, AddAdjointIsTheTranspose) {
  const ClothDerivatives cloth(&options_, sub_);
  const Columns weights = RandomColumns(12, 3, 21),
                aw = RandomColumns(12, 3, 22), am = RandomColumns(27, 3, 23);
  Columns dw = Columns::Zero(12, 3), m = Columns::Zero(27, 3);
  cloth.AddForward(*lin_, weights, &dw, &m);
  Columns a_weights = Columns::Zero(12, 3);
  cloth.AddAdjoint(*lin_, aw, am, &a_weights);
  const double forward = dw.cwiseProduct(aw).sum() + m.cwiseProduct(am).sum();
  EXPECT_NEAR(weights.cwiseProduct(a_weights).sum(), forward, 1e-12);
}

// The transposes add to what is there.
TEST_F(ClothDerivativesTest, AdjointsAddUp) {
  const ClothDerivatives cloth(&options_, sub_);
  const Columns a = RandomColumns(12, 1, 31), m = RandomColumns(27, 1, 32);
  Columns once = Columns::Zero(27, 1), twice = once;
  cloth.Adjoint(a, a, a, &once);
  for (int k = 0; k < 2; ++k) cloth.Adjoint(a, a, a, &twice);
  EXPECT_LT((twice - 2 * once).norm(), 1e-12 * once.norm());
  Columns weights = Columns::Zero(12, 1), more = weights;
  cloth.AddAdjoint(*lin_, a, m, &weights);
  for (int k = 0; k < 2; ++k) cloth.AddAdjoint(*lin_, a, m, &more);
  EXPECT_LT((more - 2 * weights).norm(), 1e-12 * weights.norm());
}

TEST_F(ClothDerivativesTest, WithoutSuchContactsNothingMoves) {
  sub_.cloth_sources.clear();
  const ClothDerivatives cloth(nullptr, sub_);
  EXPECT_TRUE(cloth.empty());
  Columns dn = Columns::Zero(12, 2), dw = dn;
  EXPECT_EQ(cloth.Forward(RandomColumns(27, 2, 1), &dn, &dw).rows(), 0);
  EXPECT_EQ(dn.norm() + dw.norm(), 0);
}

}  // namespace
}  // namespace invsim
