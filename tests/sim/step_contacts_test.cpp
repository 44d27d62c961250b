// SPDX-License-Identifier: Apache-2.0
// When contacts are sought and how they stand together; what a contact is, is
// tested with the layer that finds it.
#include "../../src/sim/step_contacts.h"

#include <gtest/gtest.h>

#include <optional>

#include "geometry/shapes.h"
#include "geometry/triangle_crossing.h"
#include "invsim/cloth/effects/self_contact.h"
#include "sphere_scene.h"

namespace invsim {
namespace {

constexpr double kShortStep = 1 / 240.0;

class StepContactsTest : public ::testing::Test {
 protected:
  // The cloth over, in or without a body, at rest.
  void Make(const Garment& garment,
            const TriangleMesh& body,
            std::vector<Pin> pins = {},
            bool self_contact = false) {
    setup_ = ClothSetup(garment, body);
    setup_.pins = std::move(pins);
    if (self_contact)
      setup_.effects.push_back(
          std::make_unique<SelfContact>(garment, SelfContactOptions{}));
    Begin(garment);
  }
  // A step of what setup_ says.
  void Begin(const Garment& garment) {
    BlockPatternBuilder builder(garment.num_vertices());
    for (const auto& effect : setup_.effects) effect->AddStencils(&builder);
    const auto pattern = builder.Build();
    for (const auto& effect : setup_.effects) effect->Bind(*pattern);
    contacts_ = std::make_unique<StepContacts>(setup_, pattern);
    sub_ = {};
    sub_.dt = kShortStep;
    sub_.start = AtRest(garment);
  }
  void Find() { contacts_->Find(setup_.body, setup_.body, &sub_, &stats_); }
  bool FindLate() {
    return contacts_->FindLate(setup_.body, setup_.body, &sub_, &stats_);
  }
  // As if the step had been solved with all vertices at this velocity.
  void SolveTo(const Points& v) {
    sub_.linearizations.resize(1);
    sub_.linearizations[0].v = Stacked(v);
  }
  Points Moving(const Vector3d& v) const {
    return v.replicate(1, sub_.start.x.cols());
  }

  SimulatorSetup setup_;
  std::unique_ptr<StepContacts> contacts_;
  SubstepRecord sub_;
  StepStats stats_;
};

TEST_F(StepContactsTest, WithoutBodyPinsAndLayersThereAreNone) {
  Make(Square(2, 0.1, 0.001), {});
  Find();
  EXPECT_FALSE(contacts_->has_body());
  EXPECT_EQ(contacts_->self_contact_options(), nullptr);
  EXPECT_EQ(contacts_->FindInside({}, sub_.start.x), 0);
  EXPECT_TRUE(sub_.contacts.empty());
  EXPECT_EQ(stats_.contact_queries, 0);
}

// Every search asks once for every vertex.
TEST_F(StepContactsTest, SearchesAreCountedByVertices) {
  Make(Square(2, 0.1, 0.001), Slab(0.2, 0.1));
  Find();
  EXPECT_TRUE(contacts_->has_body());
  EXPECT_EQ(sub_.contacts.size(), 9u);
  EXPECT_EQ(stats_.contact_queries, 9);
}

TEST_F(StepContactsTest, VerticesInsideTheBodyAreCounted) {
  const Garment sheet = Square(2, 0.1, 0.001);
  Make(sheet, Slab(0.2, 0.1));
  Points x = sheet.placed;
  EXPECT_EQ(contacts_->FindInside(setup_.body, x), 0);
  x(1, 3) = x(1, 5) = -0.01;
  EXPECT_EQ(contacts_->FindInside(setup_.body, x), 2);
}

// It is where it is pinned when the step is over, whatever the body does
// there; the others keep their contacts.
TEST_F(StepContactsTest, APinTakesTheContactsOfItsVertexAway) {
  const Garment sheet = Square(2, 0.1, 0.001);
  const Vector3d goal(0.01, 0.05, -0.02);
  Make(sheet, Slab(0.2, 0.1), {{4, goal}, {7, sheet.placed.col(7)}});
  Find();
  ASSERT_EQ(sub_.contacts.size(), 9u);
  ASSERT_EQ(sub_.sources.size(), 7u);
  for (int k = 0; k < 7; ++k) {
    EXPECT_EQ(sub_.sources[k].contact, k);
    EXPECT_EQ(sub_.contacts[k].kind, ContactKind::kUnilateral);
    EXPECT_EQ(sub_.contacts[k].vertex[0], sub_.sources[k].vertex);
    EXPECT_NE(sub_.sources[k].vertex, 4);
    EXPECT_NE(sub_.sources[k].vertex, 7);
  }
  const Contact &moved = sub_.contacts[7], &held = sub_.contacts[8];
  EXPECT_EQ(moved.kind, ContactKind::kPin);
  EXPECT_EQ(moved.vertex[0], 4);
  EXPECT_LT((sub_.start.x.col(4) + sub_.dt * moved.velocity - goal).norm(),
            1e-15);
  EXPECT_EQ(held.kind, ContactKind::kPin);
  EXPECT_EQ(held.vertex[0], 7);
  EXPECT_EQ(held.velocity.norm(), 0);
}

TEST_F(StepContactsTest, PinsNeedNoBody) {
  const Garment sheet = Square(2, 0.1, 0.001);
  Make(sheet, {}, {{0, sheet.placed.col(0)}, {8, sheet.placed.col(8)}});
  Find();
  ASSERT_EQ(sub_.contacts.size(), 2u);
  EXPECT_EQ(sub_.contacts[1].vertex[0], 8);
}

// Side by side, 2 mm apart at x = 0.
TriangleMesh TwoBalls() {
  const TriangleMesh ball = Icosphere(0.1, 2);
  const Vector3d aside(ball.vertices.row(0).maxCoeff() + 0.001, 0, 0);
  TriangleMesh both;
  both.vertices.resize(3, 2 * ball.vertices.cols());
  both.vertices << ball.vertices.colwise() - aside,
      ball.vertices.colwise() + aside;
  both.faces.resize(3, 2 * ball.faces.cols());
  both.faces << ball.faces,
      (ball.faces.array() + static_cast<int>(ball.vertices.cols())).matrix();
  return both;
}

// Between two balls a vertex has two contacts, which yield in proportion to
// how easily the vertex is moved: by its mass alone, or less in stiff cloth.
TEST_F(StepContactsTest, SharedContactsYieldLessInStiffCloth) {
  constexpr int kMiddle = 4;
  Garment sheet = Square(2, 0.02, 0);
  sheet.placed.row(0).swap(sheet.placed.row(1));  // upright
  const auto compliances = [&] {
    Begin(sheet);
    Find();
    std::vector<double> all;
    for (const BodyContact& source : sub_.sources)
      if (source.vertex == kMiddle)
        all.push_back(sub_.contacts[source.contact].compliance);
    return all;
  };
  Make(sheet, TwoBalls());
  const std::vector<double> stiff = compliances();
  setup_.effects.clear();
  const std::vector<double> loose = compliances();
  ASSERT_EQ(loose.size(), 2u);
  ASSERT_EQ(stiff.size(), 2u);
  const double by_mass =
      setup_.contact.shared_compliance * kShortStep / setup_.mass[kMiddle];
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(loose[k], by_mass, 1e-12 * by_mass);
    // The stiffest axis counts: that of the membrane, not that of bending.
    const double resistance = setup_.contact.shared_compliance / stiff[k];
    const double stiffness =
        (resistance - setup_.mass[kMiddle] / kShortStep) / kShortStep;
    EXPECT_GT(stiffness, 200);
    EXPECT_LT(stiffness, 2000);
  }
}

// From rest a fall takes a vertex further than the margin in one long step.
TEST_F(StepContactsTest, WhatGotFurtherThanLookedForIsFoundLate) {
  Make(Square(2, 0.1, 0.05), Slab(0.2, 0.1));
  Find();
  EXPECT_TRUE(sub_.contacts.empty());
  SolveTo(Moving(Vector3d(0, -0.1 / kShortStep, 0)));
  EXPECT_TRUE(FindLate());
  EXPECT_EQ(sub_.contacts.size(), 9u);
  EXPECT_EQ(sub_.sources.size(), 9u);
  EXPECT_TRUE(sub_.linearizations.empty());
  EXPECT_EQ(stats_.contact_queries, 18);
  // With these the step is solved again, and that is all there is to find.
  SolveTo(Moving(Vector3d(0, -0.1 / kShortStep, 0)));
  EXPECT_FALSE(FindLate());
  EXPECT_EQ(sub_.contacts.size(), 9u);
}

TEST_F(StepContactsTest, NothingIsSoughtLateAlongAShortWay) {
  Make(Square(2, 0.1, 0.05), Slab(0.2, 0.1));
  Find();
  SolveTo(Moving(Vector3d(0, -0.9 * setup_.contact.margin / kShortStep, 0)));
  EXPECT_FALSE(FindLate());
  EXPECT_EQ(stats_.contact_queries, 9);
  EXPECT_EQ(sub_.linearizations.size(), 1u);
}

// It is sought, and there is nothing.
TEST_F(StepContactsTest, ALongWayThatMeetsNothingChangesNothing) {
  Make(Square(2, 0.1, 0.5), Slab(0.2, 0.1), {{0, Vector3d(0, 1, 0)}});
  Find();
  SolveTo(Moving(Vector3d(0, -0.1 / kShortStep, 0)));
  EXPECT_FALSE(FindLate());
  EXPECT_EQ(sub_.contacts.size(), 1u);
  EXPECT_EQ(sub_.linearizations.size(), 1u);
  EXPECT_EQ(stats_.contact_queries, 18);
}

// Body, then pins, then layers, each with the place of its contact.
TEST_F(StepContactsTest, LateContactsStandInTheirOrder) {
  const Garment layers =
      Together(Square(2, 0.1, 0.05), Square(2, 0.09, 0.0508));
  Make(layers, Slab(0.2, 0.1), {{0, layers.placed.col(0)}}, true);
  Find();
  EXPECT_TRUE(sub_.sources.empty());
  const size_t between = sub_.cloth_sources.size();
  EXPECT_GT(between, 0u);
  SolveTo(Moving(Vector3d(0, -0.1 / kShortStep, 0)));
  ASSERT_TRUE(FindLate());
  EXPECT_EQ(sub_.sources.size(), 17u);  // all but the pinned one
  EXPECT_EQ(sub_.cloth_sources.size(), between);
  ASSERT_EQ(sub_.contacts.size(), 17 + 1 + between);
  EXPECT_EQ(sub_.contacts[17].kind, ContactKind::kPin);
  for (size_t k = 0; k < between; ++k)
    EXPECT_EQ(sub_.cloth_sources[k].contact, static_cast<int>(18 + k));
}

// Cloth on one wall of a trough, moving so that all of it ends in the other.
TEST_F(StepContactsTest, WhatSlipsPastItsFaceIsSolvedAgain) {
  Garment sheet = Square(2, 0.01, 0);
  const Vector3d normal = Vector3d(0.3, 1, 0).normalized();
  for (int i = 0; i < sheet.num_vertices(); ++i) {
    Vector3d x = sheet.placed.col(i);
    x.x() -= 0.012;
    x.y() = -0.3 * x.x();
    sheet.placed.col(i) = x + 0.002 * normal;
  }
  Make(sheet, Trough(0.2, 0.06), {{0, sheet.placed.col(0)}});
  const auto slipped = [&] {
    return contacts_->FindSlipped(setup_.body, setup_.body, &sub_, &stats_);
  };
  sub_.start.v = Moving(Vector3d(7, -2.1, 0));
  Find();
  ASSERT_EQ(sub_.contacts.size(), 9u);
  SolveTo(Moving(Vector3d(0.1, 0, 0)));
  EXPECT_FALSE(slipped());
  SolveTo(sub_.start.v);
  EXPECT_TRUE(slipped());
  EXPECT_EQ(sub_.sources.size(), 16u);  // two on each but the pinned one
  EXPECT_EQ(sub_.contacts.size(), 17u);
  EXPECT_EQ(sub_.linearizations.size(), 1u);
  EXPECT_EQ(stats_.slip_solves, 1);
  // Pressed through planes that it has.
  EXPECT_FALSE(slipped());
  EXPECT_EQ(stats_.slip_solves, 1);
}

// Near the bottom of a trough every vertex is in contact with both walls.
class BetweenTwoWalls : public StepContactsTest {
 protected:
  void SetUp() override {
    const Garment sheet = Square(2, 0.002, 0.0045);
    Make(sheet, Trough(0.2, 0.06));
    Find();
    ASSERT_EQ(sub_.sources.size(), 18u);
    for (size_t k = 0; k < 18; k += 2)
      ASSERT_EQ(sub_.sources[k].vertex, sub_.sources[k + 1].vertex);
    SolveTo(Moving(Vector3d::Zero()));
    sub_.linearizations[0].forces.assign(18, Vector3d::Zero());
  }
  // The contact yields by so many metres.
  void Load(int k, double yield) {
    const Contact& c = sub_.contacts[k];
    sub_.linearizations[0].forces[k] =
        yield / (sub_.dt * c.compliance) * c.normal;
  }
  bool Stiffen() { return contacts_->Stiffen(&sub_, &stats_); }
};

TEST_F(BetweenTwoWalls, AContactThatYieldsAloneBecomesExact) {
  Load(6, 0.0011);
  EXPECT_TRUE(Stiffen());
  EXPECT_EQ(stats_.yield_solves, 1);
  for (size_t k = 0; k < 18; ++k)
    EXPECT_EQ(sub_.contacts[k].exact(), k == 6) << k;
  EXPECT_FALSE(Stiffen());
}

TEST_F(BetweenTwoWalls, ContactsThatYieldALittleStayAsTheyAre) {
  for (int k = 0; k < 18; k += 2) Load(k, 0.0009);
  EXPECT_FALSE(Stiffen());
  EXPECT_EQ(stats_.yield_solves, 0);
}

// Two exact ones on a vertex may contradict each other.
TEST_F(BetweenTwoWalls, ContactsThatPressTogetherStayCompliant) {
  for (int k = 0; k < 18; ++k) Load(k, 0.0011);
  EXPECT_FALSE(Stiffen());
}

// Where it is led out, another part of the body may be in the way.
TEST_F(BetweenTwoWalls, ContactsOfCaughtClothStayCompliant) {
  Load(6, 0.0011);
  sub_.sources[7].side = -1;
  EXPECT_FALSE(Stiffen());
}

// Two layers 1 cm apart, of which one goes through the other.
class LayersThatMeet : public StepContactsTest {
 protected:
  LayersThatMeet() {
    layers_ = Together(Square(2, 0.1, 0), Square(2, 0.09, 0.01));
    Make(layers_, {}, {}, true);
    Find();
    down_ = Points::Zero(3, 18);
    down_.rightCols(9).row(1).setConstant(-0.02 / kShortStep);
  }

  Garment layers_;
  Points down_;
};

TEST_F(LayersThatMeet, AreFoundOnTheirWayAndSolvedAgain) {
  EXPECT_NE(contacts_->self_contact_options(), nullptr);
  EXPECT_TRUE(sub_.contacts.empty());
  SolveTo(down_);
  EXPECT_TRUE(contacts_->Sweep(0, &sub_, &stats_));
  EXPECT_FALSE(sub_.contacts.empty());
  EXPECT_EQ(sub_.contacts.size(), sub_.cloth_sources.size());
  for (const ClothContact& source : sub_.cloth_sources) {
    EXPECT_TRUE(source.swept);
    EXPECT_NEAR(std::abs(sub_.contacts[source.contact].normal.y()), 1, 1e-9);
  }
  EXPECT_EQ(stats_.sweep_solves, 1);
  EXPECT_EQ(stats_.stopped, 0);
  EXPECT_EQ(sub_.kept.size(), 0);
}

TEST_F(LayersThatMeet, AreStoppedAfterTheLastRound) {
  SolveTo(down_);
  for (int round = 0; round < 4; ++round)
    ASSERT_TRUE(contacts_->Sweep(round, &sub_, &stats_));
  EXPECT_FALSE(contacts_->Sweep(4, &sub_, &stats_));
  ASSERT_EQ(sub_.kept.size(), 18);
  EXPECT_GE(sub_.kept.minCoeff(), 0);
  EXPECT_LE(sub_.kept.maxCoeff(), 1);
  const auto stopped = (sub_.kept.array() < 1).count();
  EXPECT_GT(stopped, 0);
  EXPECT_EQ(stats_.stopped, stopped);
  EXPECT_EQ(stats_.sweep_solves, 4);
  const Points end =
      layers_.placed + kShortStep * Points(down_ * sub_.kept.asDiagonal());
  EXPECT_EQ(CountCrossings(end, layers_.faces), 0);
  EXPECT_GT(end.rightCols(9).row(1).minCoeff(), 0);
}

TEST_F(LayersThatMeet, NeedNothingIfTheyPart) {
  SolveTo(-down_);
  for (const int round : {0, 4}) {
    EXPECT_FALSE(contacts_->Sweep(round, &sub_, &stats_));
    EXPECT_EQ(sub_.kept.size(), 0);
    EXPECT_TRUE(sub_.contacts.empty());
  }
  EXPECT_EQ(stats_.sweep_solves, 0);
  EXPECT_EQ(stats_.stopped, 0);
}

// The most of any step stays.
TEST_F(LayersThatMeet, FacesThatCrossAreCounted) {
  EXPECT_EQ(stats_.most_crossings, 0);
  // The middle of the upper piece, through a face of the lower one.
  sub_.start.x.col(13) = Vector3d(0.02, -0.01, 0.008);
  Find();
  const int crossings = CountCrossings(sub_.start.x, layers_.faces);
  EXPECT_GT(crossings, 0);
  EXPECT_EQ(stats_.most_crossings, crossings);
  sub_.start = AtRest(layers_);
  Find();
  EXPECT_EQ(stats_.most_crossings, crossings);
}

}  // namespace
}  // namespace invsim
