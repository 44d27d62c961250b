// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/effects/membrane.h"

#include <algorithm>
#include <cmath>

#include "invsim/cloth/effects/tension.h"
#include "invsim/cloth/rest_shape.h"

namespace invsim {
namespace {

using Matrix32 = Eigen::Matrix<double, 3, 2>;
// The four 3x3 blocks that couple the columns of F.
using Blocks = Matrix3d[2][2];

// Component (i, j) of a symmetric 2x2 tensor is entry kVoigt[i][j] of its
// vector (11, 22, 12).
constexpr int kVoigt[2][2] = {{0, 2}, {2, 1}};

Matrix2d Tensor(const Vector3d& s) {
  Matrix2d t;
  t << s[0], s[2], s[2], s[1];
  return t;
}

Vector3d GreenStrain(const Matrix32& f) {
  return {0.5 * (f.col(0).squaredNorm() - 1.0),
          0.5 * (f.col(1).squaredNorm() - 1.0),
          f.col(0).dot(f.col(1))};
}

// (11, 22, 2 12) of the symmetric part of F^T G: the strain rate when F moves
// by G.
Vector3d StrainRate(const Matrix32& f, const Matrix32& g) {
  return {f.col(0).dot(g.col(0)),
          f.col(1).dot(g.col(1)),
          f.col(0).dot(g.col(1)) + f.col(1).dot(g.col(0))};
}

template <typename Element>
Matrix32 Gradient(const Element& e, const Points& x) {
  return x.col(e.vertices[0]) * e.d.col(0).transpose() +
         x.col(e.vertices[1]) * e.d.col(1).transpose() +
         x.col(e.vertices[2]) * e.d.col(2).transpose();
}

// blocks_ab += sum_ij q(ia, jb) left_i right_j^T, where the pairs (i, a) are
// read as tensor components.
void AddOuter(const Matrix3d& q,
              const Matrix32& left,
              const Matrix32& right,
              Blocks& blocks) {
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) {
      Matrix2d m;
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) m(i, j) = q(kVoigt[i][a], kVoigt[j][b]);
      blocks[a][b].noalias() += (left * m) * right.transpose();
    }
}

void SetToTensorTimesIdentity(const Vector3d& s, Blocks& blocks) {
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b)
      blocks[a][b] = s[kVoigt[a][b]] * Matrix3d::Identity();
}

// Vertex blocks from the blocks of F: h_ab += scale sum_ij d_ia d_jb B_ij.
template <typename Element>
void Scatter(const Element& e,
             const StencilSlots<3>& slots,
             size_t index,
             double scale,
             const Blocks& blocks,
             BlockMatrix* h) {
  for (int b = 0; b < 3; ++b) {
    const Matrix3d left =
        scale * (e.d(0, b) * blocks[0][0] + e.d(1, b) * blocks[0][1]);
    const Matrix3d right =
        scale * (e.d(0, b) * blocks[1][0] + e.d(1, b) * blocks[1][1]);
    for (int a = 0; a < 3; ++a)
      h->block(slots.slot(index, a, b)) += e.d(0, a) * left + e.d(1, a) * right;
  }
}

template <typename Element>
void ScatterForce(const Element& e,
                  double scale,
                  const Matrix32& p,
                  Points* out) {
  for (int a = 0; a < 3; ++a)
    out->col(e.vertices[a]) += scale * (p * e.d.col(a));
}

}  // namespace

Membrane::Membrane(const Garment& garment, const StretchModel& model)
    : law_(model) {
  elements_.reserve(garment.num_faces());
  for (int f = 0; f < garment.num_faces(); ++f) {
    Element e;
    for (int a = 0; a < 3; ++a) e.vertices[a] = garment.faces(a, f);
    e.area = RestArea(garment, f);
    e.d.rightCols<2>() = RestEdges(garment, f).inverse().transpose();
    e.d.col(0) = -e.d.col(1) - e.d.col(2);
    elements_.push_back(e);
  }
}

void Membrane::AddStencils(BlockPatternBuilder* builder) const {
  for (const Element& e : elements_) builder->AddStencil(e.vertices);
}

void Membrane::Bind(const BlockPattern& pattern) {
  std::vector<std::array<int, 3>> stencils;
  stencils.reserve(elements_.size());
  for (const Element& e : elements_) stencils.push_back(e.vertices);
  slots_ = StencilSlots<3>(pattern, stencils);
}

double Membrane::Energy(const ClothState& y) const {
  if (!conservative()) return 0.0;
  double energy = 0.0;
  for (const Element& e : elements_) {
    const Vector3d strain = GreenStrain(Gradient(e, y.x));
    const Matrix3d c = StretchLaw::Matrix(law_.At(strain));
    energy += 0.5 * e.area * strain.dot(c * strain);
  }
  return energy;
}

void Membrane::AddForce(const ClothState& y, Points* force) const {
  for (const Element& e : elements_) {
    const Matrix32 f = Gradient(e, y.x);
    const Vector3d strain = GreenStrain(f);
    const Vector3d stress = StretchLaw::Matrix(law_.At(strain)) * strain;
    ScatterForce(e, -e.area, f * Tensor(stress), force);
  }
}

void Membrane::AddStiffness(const ClothState& y,
                            double x_scale,
                            double v_scale,
                            BlockMatrix* a) const {
  for (size_t i = 0; i < elements_.size(); ++i) {
    const Element& e = elements_[i];
    const Matrix32 f = Gradient(e, y.x);
    const Vector3d strain = GreenStrain(f);
    const Matrix3d c = StretchLaw::Matrix(law_.At(strain));
    Blocks blocks;
    SetToTensorTimesIdentity(TensilePart(c * strain), blocks);
    AddOuter(c, f, f, blocks);
    Scatter(e, slots_, i, x_scale * e.area, blocks, a);
  }
}

void Membrane::AddStiffnessProduct(const Points& x,
                                   const Points& w,
                                   double scale,
                                   Points* out) const {
  for (const Element& e : elements_) {
    const Matrix32 f = Gradient(e, x);
    const Matrix32 g = Gradient(e, w);
    const Vector3d strain = GreenStrain(f);
    const Matrix3d c = StretchLaw::Matrix(law_.At(strain));
    ScatterForce(
        e,
        scale * e.area,
        f * Tensor(c * StrainRate(f, g)) + g * Tensor(TensilePart(c * strain)),
        out);
  }
}

void Membrane::AddTangent(const ClothState& y,
                          const Points& dx,
                          const Points& dv,
                          double scale,
                          BlockMatrix* h_x,
                          BlockMatrix* h_v) const {
  AddDerivative(Part::kForceAndProduct, y.x, dx, scale, h_x);
}

void Membrane::AddStiffnessProductTangent(const Points& x,
                                          const Points& w,
                                          double scale,
                                          BlockMatrix* h) const {
  AddDerivative(Part::kProduct, x, w, scale, h);
}

// With G the gradient of w, e and t the vectors of E and of sym(F^T G), the
// stress of the product K w alone is
//   P = F [C t] + G S+,                    S = C e,
// and of -f + K w it is that plus F S. Moving F by dF moves
//   e by sym(F^T dF),  t by sym(dF^T G),
//   C t by C dt + (dC : de) t =: C dt + T de,
//   S  by (C + U) de,  U de = (dC : de) e,
//   S+ by L (C + U) de,  L the derivative of the tensile part.
void Membrane::AddDerivative(Part part,
                             const Points& x,
                             const Points& w,
                             double scale,
                             BlockMatrix* h) const {
  for (size_t i = 0; i < elements_.size(); ++i) {
    const Element& e = elements_[i];
    const Matrix32 f = Gradient(e, x);
    const Matrix32 g = Gradient(e, w);
    const Vector3d strain = GreenStrain(f);
    const Vector3d rate = StrainRate(f, g);

    StretchLaw::ConstantsGradient dc;
    const StretchLaw::Constants constants = law_.At(strain, &dc);
    const Matrix3d c = StretchLaw::Matrix(constants);
    Matrix3d stress_slope = c;               // C + U
    Matrix3d rate_slope = Matrix3d::Zero();  // T
    if (!law_.linear())
      for (int j = 0; j < 3; ++j) {
        const Matrix3d slope = StretchLaw::Matrix(dc.col(j));
        stress_slope.col(j) += slope * strain;
        rate_slope.col(j) = slope * rate;
      }
    const Vector3d stress = c * strain;
    Matrix3d tensile_slope;
    TensilePart(stress, &tensile_slope);

    Vector3d carried = c * rate;
    if (part == Part::kForceAndProduct) {
      carried += stress;
      rate_slope += stress_slope;
    }
    Blocks blocks;
    SetToTensorTimesIdentity(carried, blocks);
    AddOuter(rate_slope, f, f, blocks);
    AddOuter(c, f, g, blocks);
    AddOuter(tensile_slope * stress_slope, g, f, blocks);
    Scatter(e, slots_, i, scale * e.area, blocks, h);
  }
}

MembraneFields Membrane::Fields(const Points& x) const {
  const int faces = static_cast<int>(elements_.size());
  MembraneFields fields;
  fields.strain.resize(3, faces);
  fields.stress.resize(3, faces);
  fields.von_mises.resize(faces);
  for (int i = 0; i < faces; ++i) {
    const Vector3d e = GreenStrain(Gradient(elements_[i], x));
    const Vector3d s = StretchLaw::Matrix(law_.At(e)) * e;
    fields.strain.col(i) = e;
    fields.stress.col(i) = s;
    // F S F^T / J has the principal values of S (F^T F) / J in its plane.
    const Matrix2d metric =
        Matrix2d::Identity() + Tensor(Vector3d(2.0 * e[0], 2.0 * e[1], e[2]));
    const double j = std::sqrt(std::max(metric.determinant(), 1e-12));
    const Matrix2d cauchy = Tensor(s) * metric / j;
    const double trace = cauchy.trace();
    fields.von_mises[i] =
        std::sqrt(std::max(0.0, trace * trace - 3.0 * cauchy.determinant()));
  }
  return fields;
}

MatrixXd FaceToVertexAverage(const Garment& garment, const MatrixXd& per_face) {
  MatrixXd sum = MatrixXd::Zero(per_face.rows(), garment.num_vertices());
  VectorXd weight = VectorXd::Zero(garment.num_vertices());
  for (int f = 0; f < garment.num_faces(); ++f) {
    const double area = RestArea(garment, f);
    for (int a = 0; a < 3; ++a) {
      sum.col(garment.faces(a, f)) += area * per_face.col(f);
      weight[garment.faces(a, f)] += area;
    }
  }
  for (int i = 0; i < garment.num_vertices(); ++i)
    if (weight[i] > 0.0) sum.col(i) /= weight[i];
  return sum;
}

}  // namespace invsim
