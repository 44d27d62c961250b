// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SIM_SENSITIVITY_H_
#define INVSIM_SIM_SENSITIVITY_H_

// The derivative of a simulated frame: of the cloth at its end with respect to
// the body's position at its end (and at its start), and to the cloth at its
// start, through all sub-steps and linearisations.
//
// Exact for the scheme, with the contact set and modes of the solution: all
// that a sub-step depends on is in it (contact point, normal, body velocity,
// gap, the stiffness frozen at the start of each sub-step). Where a contact
// changes its face, feature or mode the frame is only piecewise smooth; the
// derivative is then that of the piece the solution lies on.
//
// Approximate in two places, both of the cloth's contact with itself: normals
// and weights of contacts that the sweep found (ClothContact::swept) are held
// fixed, and so is the share of its way that a stopped vertex went
// (SubstepRecord::kept). FixedContacts counts them.

#include <memory>
#include <vector>

#include "invsim/contact/friction_jacobian.h"
#include "invsim/sim/frame_record.h"
#include "invsim/sim/simulator.h"

namespace invsim {

// Derivatives of, or adjoints to, positions and velocities: 3N x p.
struct StateColumns {
  Columns x;
  Columns v;
};

// Swept contacts and stopped vertices of the frame: where it is zero, the
// derivative is exact.
int FixedContacts(const FrameRecord& record);

struct SensitivityStats {
  int factorizations = 0;
  int failed = 0;  // singular; the result is then not to be used
  double tangent_seconds = 0;
  double factor_seconds = 0;
  double solve_seconds = 0;
};

class Sensitivity {
 public:
  explicit Sensitivity(const Simulator& simulator);
  ~Sensitivity();

  // The body's vertices on which the frame's contacts lie, ascending. The
  // derivative with respect to any other is zero.
  static std::vector<int> BodyVertices(const Faces& body_faces,
                                       const FrameRecord& record);

  // d(x, v at the end) for p directions. `vertices` as from BodyVertices;
  // `body0`, `body1`: 3 rows per entry of `vertices`, p columns, how those
  // move at the start and the end of the frame (an empty matrix: they do
  // not). `start`: how the cloth moves at the start (null: it does not).
  bool Forward(const FrameRecord& record,
               const std::vector<int>& vertices,
               const Columns& body0,
               const Columns& body1,
               const StateColumns* start,
               StateColumns* end);

  // The transpose for p covectors: `end` holds weights on (x, v) at the end.
  // Fills those of body0 and body1 (3 rows per entry of `vertices`) and of
  // the cloth at the start; any of them may be null.
  bool Adjoint(const FrameRecord& record,
               const std::vector<int>& vertices,
               const StateColumns& end,
               Columns* body0,
               Columns* body1,
               StateColumns* start);

  const SensitivityStats& stats() const { return stats_; }
  void ResetStats() { stats_ = {}; }

 private:
  void Tangents(const SubstepRecord& sub,
                size_t index,
                BlockMatrix* h_x,
                BlockMatrix* h_v);
  bool Factor(const SubstepRecord& sub, const LinearizationRecord& lin);

  const Simulator& simulator_;
  FrictionJacobian jacobian_;
  SensitivityStats stats_;
};

}  // namespace invsim

#endif  // INVSIM_SIM_SENSITIVITY_H_
