// SPDX-License-Identifier: Apache-2.0
#include "invsim/sim/frame_record.h"

#include "invsim/contact/coulomb.h"

namespace invsim {
namespace {

ContactMode Mode(const SubstepRecord& sub, size_t k) {
  const Contact& c = sub.contacts[k];
  const LinearizationRecord& lin = sub.linearizations.back();
  const Vector3d u = c.Gather(lin.v) - c.velocity;
  if (!c.exact())
    return DifferentiateCompliantForce(c.normal, c.friction, c.compliance, u)
        .mode;
  const double rho = lin.a.diagonal(c.vertex[0]).trace() / 3;
  return LinearizeAlartCurnier(c.normal, c.friction, rho, lin.forces[k], u)
      .mode;
}

}  // namespace

bool SameContacts(const FrameRecord& a, const FrameRecord& b) {
  if (a.substeps.size() != b.substeps.size()) return false;
  for (size_t s = 0; s < a.substeps.size(); ++s) {
    const SubstepRecord &x = a.substeps[s], &y = b.substeps[s];
    if (x.s0 != y.s0 || x.s1 != y.s1 || x.sources.size() != y.sources.size())
      return false;
    for (size_t k = 0; k < x.sources.size(); ++k) {
      const BodyContact &p = x.sources[k], &q = y.sources[k];
      if (p.vertex != q.vertex || p.face != q.face || p.feature != q.feature ||
          x.contacts[p.contact].exact() != y.contacts[q.contact].exact() ||
          Mode(x, p.contact) != Mode(y, q.contact))
        return false;
    }
    if (x.cloth_sources.size() != y.cloth_sources.size() || x.kept != y.kept)
      return false;
    for (size_t k = 0; k < x.cloth_sources.size(); ++k) {
      const ClothContact &p = x.cloth_sources[k], &q = y.cloth_sources[k];
      if (p.vertex != q.vertex || p.feature != q.feature || p.side != q.side ||
          p.swept != q.swept || Mode(x, p.contact) != Mode(y, q.contact))
        return false;
    }
  }
  return true;
}

}  // namespace invsim
