// SPDX-License-Identifier: Apache-2.0
#include "cloth_derivatives.h"

namespace invsim {
namespace {

// A plane that stands still in space: only the gap moves.
ClothPlaneJacobian FixedPlane(const SelfContactOptions& options,
                              double dt,
                              const Contact& contact) {
  ClothPlaneJacobian jacobian = ClothPlaneJacobian::Zero();
  const Vector3d& n = contact.normal;
  if (n.dot(contact.velocity) >= options.recovery_speed) return jacobian;
  for (int k = 0; k < contact.num_vertices; ++k)
    jacobian.block<3, 3>(3, 3 * k) =
        -contact.weight[k] / dt * (n * n.transpose());
  return jacobian;
}

}  // namespace

ClothDerivatives::ClothDerivatives(const SelfContactOptions* options,
                                   const SubstepRecord& sub)
    : sub_(sub) {
  jacobians_.reserve(sub.cloth_sources.size());
  for (const ClothContact& source : sub.cloth_sources) {
    const Contact& contact = sub.contacts[source.contact];
    PairPoints x = PairPoints::Zero();
    for (int k = 0; k < contact.num_vertices; ++k)
      x.col(k) = sub.start.x.col(contact.vertex[k]);
    jacobians_.push_back(
        source.swept ? FixedPlane(*options, sub.dt, contact)
                     : DifferentiateClothPlane(*options, sub.dt, source, x));
  }
}

Columns ClothDerivatives::Forward(const Columns& x0,
                                  Columns* dn,
                                  Columns* dw) const {
  Columns weights = Columns::Zero(
      4 * static_cast<Eigen::Index>(jacobians_.size()), x0.cols());
  for (size_t i = 0; i < jacobians_.size(); ++i) {
    const Contact& c = sub_.contacts[sub_.cloth_sources[i].contact];
    const int row = 3 * sub_.cloth_sources[i].contact;
    for (int k = 0; k < c.num_vertices; ++k) {
      const auto moves = x0.middleRows<3>(3 * c.vertex[k]);
      const auto j = jacobians_[i].middleCols<3>(3 * k);
      dn->middleRows<3>(row).noalias() += j.topRows<3>().lazyProduct(moves);
      dw->middleRows<3>(row).noalias() += j.middleRows<3>(3).lazyProduct(moves);
      weights.middleRows<4>(4 * i).noalias() +=
          j.bottomRows<4>().lazyProduct(moves);
    }
  }
  return weights;
}

void ClothDerivatives::AddForward(const LinearizationRecord& lin,
                                  const Columns& weights,
                                  Columns* dw,
                                  Columns* m) const {
  for (size_t i = 0; i < jacobians_.size(); ++i) {
    const int contact = sub_.cloth_sources[i].contact;
    const Contact& c = sub_.contacts[contact];
    const Vector3d& r = lin.forces[contact];
    for (int k = 0; k < c.num_vertices; ++k) {
      const auto weight = weights.row(4 * i + k);
      for (int a = 0; a < 3; ++a) {
        dw->row(3 * contact + a) -= lin.v[3 * c.vertex[k] + a] * weight;
        m->row(3 * c.vertex[k] + a) += r[a] * weight;
      }
    }
  }
}

void ClothDerivatives::AddAdjoint(const LinearizationRecord& lin,
                                  const Columns& dw,
                                  const Columns& m,
                                  Columns* weights) const {
  for (size_t i = 0; i < jacobians_.size(); ++i) {
    const int contact = sub_.cloth_sources[i].contact;
    const Contact& c = sub_.contacts[contact];
    const Vector3d& r = lin.forces[contact];
    for (int k = 0; k < c.num_vertices; ++k)
      for (int a = 0; a < 3; ++a)
        weights->row(4 * i + k) +=
            r[a] * m.row(3 * c.vertex[k] + a) -
            lin.v[3 * c.vertex[k] + a] * dw.row(3 * contact + a);
  }
}

void ClothDerivatives::Adjoint(const Columns& dn,
                               const Columns& dw,
                               const Columns& weights,
                               Columns* x0) const {
  for (size_t i = 0; i < jacobians_.size(); ++i) {
    const Contact& c = sub_.contacts[sub_.cloth_sources[i].contact];
    const int row = 3 * sub_.cloth_sources[i].contact;
    for (int k = 0; k < c.num_vertices; ++k) {
      const auto j = jacobians_[i].middleCols<3>(3 * k);
      x0->middleRows<3>(3 * c.vertex[k]).noalias() +=
          j.topRows<3>().transpose().lazyProduct(dn.middleRows<3>(row)) +
          j.middleRows<3>(3).transpose().lazyProduct(dw.middleRows<3>(row)) +
          j.bottomRows<4>().transpose().lazyProduct(
              weights.middleRows<4>(4 * i));
    }
  }
}

}  // namespace invsim
