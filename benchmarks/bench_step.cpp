// SPDX-License-Identifier: Apache-2.0

// One sub-step of cloth on a moving body, and its derivative, against the limit
// of any method with the same matrix: one numeric Cholesky factorisation, and
// one solve with as many right sides as the body has parameters. Cloth draped
// over a ball, about 40 % of it in contact, friction 0.3, steps of 5 ms.

#include <cmath>
#include <string>

#include "benchmarks.h"
#include "invsim/algebra/sparse_cholesky.h"
#include "invsim/algebra/sparse_lu.h"
#include "invsim/body/body_model.h"
#include "invsim/sim/sensitivity.h"
#include "sim/sphere_scene.h"

namespace invsim {
namespace {

constexpr double kStep = 0.005;

// Cloth that fell onto the ball, and the ball a step later.
struct Drape {
  Drape(int cells, int settle) {
    ball = Icosphere(0.19, 4);
    const Garment garment = Square(cells, 0.6, 0.194);
    SimulatorSetup setup = ClothSetup(garment, ball);
    setup.step.substeps = 1;
    simulator = std::make_unique<Simulator>(std::move(setup));
    state = AtRest(garment);
    StepStats unused;
    for (int k = 0; k < settle; ++k)
      simulator->Advance(
          ball.vertices, ball.vertices, 2 * kStep, &state, &unused);
    moved = ball.vertices.colwise() + Vector3d(0.5 * kStep, 0, 0.2 * kStep);
    // A step to warm up, so that every measured one starts alike.
    simulator->Advance(ball.vertices, moved, kStep, &state, &unused);
    Step(&record);
  }
  void Step(FrameRecord* out) {
    ClothState copy = state;
    stats = {};
    const Points next = moved.colwise() + Vector3d(0.5 * kStep, 0, 0.2 * kStep);
    simulator->Advance(moved, next, kStep, &copy, &stats, out);
  }
  TriangleMesh ball;
  Points moved;
  std::unique_ptr<Simulator> simulator;
  ClothState state;
  FrameRecord record;
  StepStats stats;
};

void BenchSize(Bench* bench, int cells, int settle) {
  Drape drape(cells, settle);
  const int n = drape.simulator->num_vertices();
  const SubstepRecord& sub = drape.record.substeps[0];
  const BlockMatrix& a = sub.linearizations[0].a;
  const int contacts = drape.stats.stick + drape.stats.slide;
  const auto add = [&](const char* name, double value, const char* unit) {
    bench->Add({name, n, contacts, value, unit});
  };
  SparseCholesky cholesky(a.shared_pattern());
  const auto factor = [&] { cholesky.Factor(a); };
  const auto step = [&] { drape.Step(nullptr); };
  add("step/seconds", bench->Seconds(step), "s");
  add("step/factorisation_seconds", bench->Seconds(factor), "s");
  add("step/ratio_to_factorisation", bench->Ratio(step, factor), "ratio");
  add("step/factorisations", drape.stats.factorizations, "count");
  add("step/solves", drape.stats.solves, "count");
  add("step/residual", drape.stats.worst_residual, "weights");

  const std::vector<int> vertices =
      Sensitivity::BodyVertices(drape.simulator->body_faces(), drape.record);
  std::srand(1);
  const Columns body =
      MatrixXd::Random(3 * vertices.size(), kNumBodyParameters);
  Sensitivity sensitivity(*drape.simulator);
  StateColumns end;
  const auto derivative = [&] {
    sensitivity.Forward(drape.record, vertices, Columns(), body, nullptr, &end);
  };
  Columns right = MatrixXd::Random(3 * n, kNumBodyParameters);
  const auto solve = [&] { cholesky.Solve(&right); };
  add("sensitivity/seconds", bench->Seconds(derivative), "s");
  add("sensitivity/solve_seconds", bench->Seconds(solve), "s");
  add("sensitivity/ratio_to_solve", bench->Ratio(derivative, solve), "ratio");
  SparseLu lu(a.shared_pattern());
  add("sensitivity/lu_ratio_to_factorisation",
      bench->Ratio([&] { lu.Factor(a); }, factor),
      "ratio");
  add("step/peak_memory", PeakMemoryMegabytes(), "MB");
}

}  // namespace

void BenchStep(Bench* bench) {
  if (!bench->Wants("step/") && !bench->Wants("sensitivity/")) return;
  const size_t first = bench->rows().size();
  BenchSize(bench, 35, 60);
  BenchSize(bench, 70, 20);
  BenchSize(bench, 140, 2);
  std::vector<double> sizes, seconds;
  for (size_t k = first; k < bench->rows().size(); ++k) {
    const BenchRow& row = bench->rows()[k];
    if (row.name != "step/seconds") continue;
    sizes.push_back(row.vertices);
    seconds.push_back(row.value);
  }
  bench->Add({"step/growth", 0, 0, GrowthExponent(sizes, seconds), "exponent"});
}

}  // namespace invsim
