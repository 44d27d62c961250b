// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "invsim/base/error.h"
#include "prepared_body.h"

namespace invsim {
namespace {

// How far a row of weights may miss one: 32-bit files miss by 1e-6, files
// with rounded text by 1e-3; more is a wrong array.
constexpr double kLargestSumError = 0.01;
// Negative weights down to here are rounding of an exporter, and taken as zero.
constexpr double kLargestNegativeWeight = 1e-4;

std::string ShapeText(Eigen::Index rows, Eigen::Index cols) {
  return std::to_string(rows) + " x " + std::to_string(cols);
}

template <typename Matrix>
void RequireShape(const Matrix& m,
                  Eigen::Index rows,
                  Eigen::Index cols,
                  const std::string& what) {
  if (m.rows() == rows && m.cols() == cols) return;
  throw InputError(what + " is " + ShapeText(m.rows(), m.cols()) +
                   ": expected " + ShapeText(rows, cols));
}

// `dense` is stored as in the file, so that the first bad value is its index.
template <typename Matrix>
void RequireFinite(const Matrix& m, const std::string& what) {
  if (m.allFinite()) return;
  for (Eigen::Index k = 0; k < m.size(); ++k) {
    if (!std::isfinite(m.data()[k])) {
      throw InputError(what + " holds " + std::to_string(m.data()[k]) +
                       " (value " + std::to_string(k) +
                       "): expected finite numbers");
    }
  }
}

void CheckParents(const std::vector<int>& parents, const std::string& name) {
  if (parents.size() != kNumJoints) {
    throw InputError(name + ": kintree_table has " +
                     std::to_string(parents.size()) +
                     " joints: expected the 24 of SMPL");
  }
  for (int j = 0; j < kNumJoints; ++j) {
    const bool right =
        j == 0 ? parents[j] == -1 : parents[j] >= 0 && parents[j] < j;
    if (!right) {
      throw InputError(
          name + ": kintree_table: joint " + std::to_string(j) +
          " has parent " + std::to_string(parents[j]) + ": expected " +
          (j == 0 ? "-1 (the root)"
                  : "a joint before it, 0 to " + std::to_string(j - 1)));
    }
  }
}

void CheckFaces(const Faces& faces,
                Eigen::Index num_vertices,
                const std::string& name) {
  for (Eigen::Index f = 0; f < faces.cols(); ++f) {
    for (int c = 0; c < 3; ++c) {
      if (faces(c, f) < 0 || faces(c, f) >= num_vertices) {
        throw InputError(name + ": f: face " + std::to_string(f) +
                         " names vertex " + std::to_string(faces(c, f)) +
                         ": expected 0 to " + std::to_string(num_vertices - 1));
      }
    }
  }
}

void ScaleRow(double sum,
              Eigen::Index row,
              const std::string& what,
              MatrixXd* m) {
  if (std::abs(sum - 1.0) > kLargestSumError) {
    throw InputError(what + ": row " + std::to_string(row) + " sums to " +
                     std::to_string(sum) + ": expected 1");
  }
  m->row(row) /= sum;
}

void NormaliseWeights(const std::string& what, MatrixXd* weights) {
  for (Eigen::Index i = 0; i < weights->rows(); ++i) {
    if (weights->row(i).minCoeff() < -kLargestNegativeWeight) {
      throw InputError(what + ": row " + std::to_string(i) + " holds " +
                       std::to_string(weights->row(i).minCoeff()) +
                       ": expected no negative weight");
    }
    weights->row(i) = weights->row(i).cwiseMax(0.0).eval();
    ScaleRow(weights->row(i).sum(), i, what, weights);
  }
}

}  // namespace

BodyModelData CheckBodyModelData(BodyModelData data, const std::string& name) {
  const Eigen::Index n = data.v_template.cols();
  if (n == 0 || data.faces.cols() == 0) {
    throw InputError(name + ": a body of " + std::to_string(n) +
                     " vertices and " + std::to_string(data.faces.cols()) +
                     " faces: expected a mesh");
  }
  RequireShape(data.shapedirs, 3 * n, kNumShape, name + ": shapedirs");
  if (data.posedirs.size() > 0) {
    RequireShape(data.posedirs, 3 * n, kNumPoseFeatures, name + ": posedirs");
  }
  RequireShape(data.joint_regressor, kNumJoints, n, name + ": J_regressor");
  RequireShape(data.weights, n, kNumJoints, name + ": weights");
  RequireFinite(data.v_template, name + ": v_template");
  RequireFinite(data.shapedirs, name + ": shapedirs");
  RequireFinite(data.posedirs, name + ": posedirs");
  RequireFinite(data.joint_regressor, name + ": J_regressor");
  RequireFinite(data.weights, name + ": weights");
  CheckParents(data.parents, name);
  CheckFaces(data.faces, n, name);
  NormaliseWeights(name + ": weights", &data.weights);
  for (int j = 0; j < kNumJoints; ++j) {
    ScaleRow(data.joint_regressor.row(j).sum(),
             j,
             name + ": J_regressor",
             &data.joint_regressor);
  }
  if (data.posedirs.size() > 0 && data.posedirs.isZero(0.0)) {
    data.posedirs.resize(0, 0);
  }
  return data;
}

}  // namespace invsim
