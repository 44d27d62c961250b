// SPDX-License-Identifier: Apache-2.0

// One sub-step of cloth on a moving body, and its derivative, against the limit
// of any method with the same matrix: one numeric Cholesky factorisation, and
// one solve with as many right sides as the body has parameters. Cloth draped
// over a ball, about 40 % of it in contact, friction 0.3, steps of 5 ms.

#include <algorithm>
#include <cmath>
#include <memory>
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

// The cloth at which the sizes start: it has come to rest on the ball.
constexpr int kCoarse = 35;
constexpr int kSettle = 80;
constexpr double kRadius = 0.32;

std::unique_ptr<Simulator> MakeSimulator(int cells, const TriangleMesh& ball) {
  SimulatorSetup setup = ClothSetup(Square(cells, 0.6, kRadius + 0.004), ball);
  setup.step.substeps = 1;
  return std::make_unique<Simulator>(std::move(setup));
}

// The state of a square of `cells` cells, `factor` times finer.
Points Refined(const Points& coarse, int cells, int factor) {
  const int n = cells * factor;
  Points fine(3, (n + 1) * (n + 1));
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const int i0 = std::min(i / factor, cells - 1);
      const int j0 = std::min(j / factor, cells - 1);
      const double s = static_cast<double>(i) / factor - i0;
      const double t = static_cast<double>(j) / factor - j0;
      const auto at = [&](int a, int b) {
        return coarse.col((i0 + a) * (cells + 1) + j0 + b);
      };
      fine.col(i * (n + 1) + j) =
          (1 - s) * ((1 - t) * at(0, 0) + t * at(0, 1)) +
          s * ((1 - t) * at(1, 0) + t * at(1, 1));
    }
  }
  return fine;
}

// Cloth at rest on the ball, which then moved for ten steps.
struct Drape {
  explicit Drape(int factor) {
    ball = Icosphere(kRadius, 4);
    simulator = MakeSimulator(kCoarse, ball);
    state = AtRest(Square(kCoarse, 0.6, kRadius + 0.004));
    Settle(kSettle);
    if (factor > 1) {
      simulator = MakeSimulator(kCoarse * factor, ball);
      state.x = Refined(state.x, kCoarse, factor);
      state.v.setZero(3, state.x.cols());
      Settle(20);
    }
    // The ball moves on for a while, as bodies do.
    for (int k = 0; k < 10; ++k) Step(nullptr);
    stats = {};
    Step(&record);
  }
  void Settle(int steps) {
    StepStats unused;
    for (int k = 0; k < steps; ++k)
      simulator->Advance(
          ball.vertices, ball.vertices, 2 * kStep, &state, &unused);
  }
  Points Next() const {
    return ball.vertices.colwise() + Vector3d(0.5 * kStep, 0, 0.2 * kStep);
  }
  // The next step of the simulation; each starts from the one before.
  void Step(FrameRecord* out) {
    simulator->Advance(ball.vertices, Next(), kStep, &state, &stats, out);
    ball.vertices = Next();
  }
  TriangleMesh ball;
  std::unique_ptr<Simulator> simulator;
  ClothState state;
  FrameRecord record;
  StepStats stats;
};

void BenchSize(Bench* bench, int refinement) {
  Drape drape(refinement);
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
  const double steps = drape.stats.substeps;
  add("step/factorisations", drape.stats.factorizations / steps, "a step");
  add("step/solves", drape.stats.solves / steps, "a step");
  add("step/missed", drape.stats.missed, "count");
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
  BenchSize(bench, 1);
  BenchSize(bench, 2);
  BenchSize(bench, 4);
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
