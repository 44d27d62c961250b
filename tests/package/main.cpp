// SPDX-License-Identifier: Apache-2.0
// Calls into several layers, so that the libraries behind each must link, and
// returns 0 if the answers are right.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "invsim/algebra/sparse_cholesky.h"
#include "invsim/base/config.h"
#include "invsim/base/threads.h"
#include "invsim/fit/loss.h"
#include "invsim/geometry/surface_index.h"
#include "invsim/io/obj.h"
#include "invsim/report/chart.h"

namespace {

// Option files: a key comes back (toml++).
bool ReadsConfig() {
  const auto config = invsim::Config::FromText("[a]\nb = 2\n", "text");
  return config.entries().count("a.b") == 1;
}

// Solves 2 x = (1, 1, 1) (CHOLMOD).
bool SolvesSparse() {
  const auto pattern = invsim::BlockPatternBuilder(1).Build();
  invsim::BlockMatrix a(pattern);
  a.SetZero();
  a.diagonal(0) = 2 * invsim::Matrix3d::Identity();
  invsim::SparseCholesky cholesky(pattern);
  invsim::VectorXd x = invsim::VectorXd::Ones(3);
  if (!cholesky.Factor(a)) return false;
  cholesky.Solve(&x);
  return (x.array() - 0.5).abs().maxCoeff() < 1e-15;
}

// The point of a triangle nearest to one above it (OBJ reader, Embree).
bool FindsClosestPoint() {
  const auto mesh =
      invsim::ParseObj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "triangle.obj");
  const invsim::SurfaceIndex index(mesh.vertices, mesh.faces);
  const auto nearest = index.Nearest(invsim::Vector3d(0.25, 0.25, 2));
  return std::abs(nearest.distance - 2) < 1e-12;
}

// The losses of a fit by name (Ceres), a number as reports print it.
bool KnowsLossesAndReports() {
  const auto names = invsim::Losses().names();
  return std::find(names.begin(), names.end(), "cauchy") != names.end() &&
         invsim::ShortNumber(0.5) == "0.5";
}

}  // namespace

int main() {
  invsim::SetThreads(1);
  const bool right = ReadsConfig() && SolvesSparse() && FindsClosestPoint() &&
                     KnowsLossesAndReports();
  std::printf("invsim package: %s\n", right ? "right" : "WRONG");
  return right ? 0 : 1;
}
