// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_SIM_STEP_CONTACTS_H_
#define INVSIM_SRC_SIM_STEP_CONTACTS_H_

// The contacts of one sub-step: of cloth with the body, with pins and, if the
// effect is among the scene's, with itself. What can be known when the step
// begins is found first; what only its solution shows is added later, and the
// step is solved again.

#include <memory>

#include "invsim/contact/body_contact.h"
#include "invsim/contact/cloth_contact.h"
#include "invsim/sim/simulator.h"

namespace invsim {

class StepContacts {
 public:
  // Keeps the reference.
  StepContacts(const SimulatorSetup& setup,
               std::shared_ptr<const BlockPattern> pattern);

  bool has_body() const { return body_ != nullptr; }
  // Null if cloth does not meet itself.
  const SelfContactOptions* self_contact_options() const;

  // Fills the contacts of `sub` and their sources; the body moves from b0 to
  // b1.
  void Find(const Points& b0,
            const Points& b1,
            SubstepRecord* sub,
            StepStats* stats);
  // True if a vertex that got further than was looked for met something: the
  // contacts are then those found along the way it took.
  bool FindLate(const Points& b0,
                const Points& b1,
                SubstepRecord* sub,
                StepStats* stats);
  // True if a vertex slid past the face that held it and into another one;
  // there are then contacts with that, too.
  bool FindSlipped(const Points& b0,
                   const Points& b1,
                   SubstepRecord* sub,
                   StepStats* stats);
  // True if a contact that is compliant because there are others on its vertex
  // gives way too far though all of them are open and the vertex is outside
  // the body; it is exact then.
  bool Stiffen(SubstepRecord* sub, StepStats* stats) const;
  // True if cloth touches cloth on its way; there are then contacts against it.
  // After the last round it is stopped instead (SubstepRecord::kept).
  bool Sweep(int round, SubstepRecord* sub, StepStats* stats);

  // BodyContactDetector's; none without a body.
  int FindInside(const Points& body, const Points& x);

 private:
  VectorXd VertexStiffness() const;
  // Per vertex, the force that gives it 1 m/s among others that hold still.
  VectorXd Resistance(double dt) const;
  void FindOnBody(const Points& b0,
                  const Points& b1,
                  const Points* v1,
                  SubstepRecord* sub,
                  StepStats* stats);
  void AddPins(SubstepRecord* sub) const;
  void FindOnCloth(SubstepRecord* sub, StepStats* stats);

  const SimulatorSetup& setup_;
  std::shared_ptr<const BlockPattern> pattern_;
  std::unique_ptr<BodyContactDetector> body_;
  std::unique_ptr<ClothContactDetector> cloth_;
  VectorXd stiffness_;  // of a vertex among others that hold still, N/m
};

}  // namespace invsim

#endif  // INVSIM_SRC_SIM_STEP_CONTACTS_H_
