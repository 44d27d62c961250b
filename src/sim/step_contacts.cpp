// SPDX-License-Identifier: Apache-2.0
#include "step_contacts.h"

#include <algorithm>
#include <utility>

#include "invsim/base/stopwatch.h"
#include "invsim/cloth/effects/self_contact.h"

namespace invsim {
namespace {

// How often a step is solved again with contacts for cloth that touched cloth
// on its way, before it is stopped.
constexpr int kSweeps = 4;

// How far a contact may yield in a step where it need not, m.
constexpr double kMostYield = 1e-3;

}  // namespace

StepContacts::StepContacts(const SimulatorSetup& setup,
                           std::shared_ptr<const BlockPattern> pattern)
    : setup_(setup), pattern_(std::move(pattern)) {
  if (setup.body_faces.cols() > 0)
    body_ = std::make_unique<BodyContactDetector>(setup.body, setup.body_faces);
  for (const auto& effect : setup.effects)
    if (const auto* self = dynamic_cast<const SelfContact*>(effect.get()))
      cloth_ = std::make_unique<ClothContactDetector>(
          *self, setup.faces, setup.mass);
  stiffness_ = VertexStiffness();
}

const SelfContactOptions* StepContacts::self_contact_options() const {
  return cloth_ ? &cloth_->options() : nullptr;
}

int StepContacts::FindInside(const Points& body, const Points& x) {
  return body_ ? body_->FindInside(body, x) : 0;
}

// Along its stiffest axis, at the position that came with the setup_. A
// constant: what depends on it needs no derivative.
VectorXd StepContacts::VertexStiffness() const {
  VectorXd k = VectorXd::Zero(pattern_->size);
  if (setup_.cloth.cols() == 0) return k;
  BlockMatrix a(pattern_);
  const ClothState still{setup_.cloth, Points::Zero(3, pattern_->size)};
  for (const auto& effect : setup_.effects)
    effect->AddStiffness(still, 1, 0, &a);
  for (int i = 0; i < pattern_->size; ++i)
    k[i] = a.diagonal(i).diagonal().maxCoeff();
  return k;
}

VectorXd StepContacts::Resistance(double dt) const {
  return setup_.mass / dt + dt * stiffness_;
}

void StepContacts::Find(const Points& b0,
                        const Points& b1,
                        SubstepRecord* sub,
                        StepStats* stats) {
  const Stopwatch watch;
  FindOnBody(b0, b1, nullptr, sub, stats);
  if (cloth_) FindOnCloth(sub, stats);
  stats->detection_seconds += watch.seconds();
}

void StepContacts::FindOnBody(const Points& b0,
                              const Points& b1,
                              const Points* v1,
                              SubstepRecord* sub,
                              StepStats* stats) {
  if (body_) {
    stats->contact_queries += pattern_->size;
    body_->Detect(setup_.contact,
                  sub->dt,
                  b0,
                  b1,
                  sub->start.x,
                  sub->start.v,
                  Resistance(sub->dt),
                  &sub->contacts,
                  &sub->sources,
                  v1);
  }
  AddPins(sub);
}

void StepContacts::AddPins(SubstepRecord* sub) const {
  for (const Pin& pin : setup_.pins) {
    Contact contact;
    contact.kind = ContactKind::kPin;
    contact.vertex[0] = pin.vertex;
    contact.velocity = (pin.position - sub->start.x.col(pin.vertex)) / sub->dt;
    // A pinned vertex cannot also be in contact.
    size_t kept = 0;
    for (size_t k = 0; k < sub->sources.size(); ++k) {
      if (sub->sources[k].vertex == pin.vertex) continue;
      sub->contacts[kept] = sub->contacts[k];
      sub->sources[kept] = sub->sources[k];
      sub->sources[kept].contact = static_cast<int>(kept);
      ++kept;
    }
    sub->contacts.erase(sub->contacts.begin() + kept,
                        sub->contacts.begin() + sub->sources.size());
    sub->sources.resize(kept);
    sub->contacts.push_back(contact);
  }
}

// Contacts are sought as far as vertices can get at the speed they start with,
// and a margin. In a long step gravity alone takes them further.
bool StepContacts::FindLate(const Points& b0,
                            const Points& b1,
                            SubstepRecord* sub,
                            StepStats* stats) {
  const Stopwatch watch;
  const LinearizationRecord& lin = sub->linearizations.back();
  const Points v1 = Eigen::Map<const Points>(lin.v.data(), 3, pattern_->size);
  const double margin = setup_.contact.margin / sub->dt;
  if (!((v1.colwise().norm().array() >
         sub->start.v.colwise().norm().array() + margin)
            .any()))
    return false;
  SubstepRecord again;
  again.dt = sub->dt;
  again.start = sub->start;
  FindOnBody(b0, b1, &v1, &again, stats);
  const bool more = again.sources.size() > sub->sources.size();
  if (more) {
    sub->contacts = std::move(again.contacts);
    sub->sources = std::move(again.sources);
    sub->cloth_sources.clear();
    sub->linearizations.clear();
    if (cloth_) FindOnCloth(sub, stats);
  }
  stats->detection_seconds += watch.seconds();
  return more;
}

bool StepContacts::FindSlipped(const Points& b0,
                               const Points& b1,
                               SubstepRecord* sub,
                               StepStats* stats) {
  const Stopwatch watch;
  const LinearizationRecord& lin = sub->linearizations.back();
  const bool more = body_->FindSlipped(setup_.contact,
                                       sub->dt,
                                       b0,
                                       b1,
                                       sub->start.x,
                                       Eigen::Map<const Points>(
                                           lin.v.data(), 3, pattern_->size),
                                       Resistance(sub->dt),
                                       &sub->contacts,
                                       &sub->sources) > 0;
  stats->slip_solves += more;
  stats->detection_seconds += watch.seconds();
  return more;
}

bool StepContacts::Stiffen(SubstepRecord* sub, StepStats* stats) const {
  const std::vector<Vector3d>& forces = sub->linearizations.back().forces;
  constexpr int kNone = -1, kSeveral = -2;
  std::vector<int> loaded(pattern_->size, kNone);
  for (const BodyContact& source : sub->sources) {
    int& on = loaded[source.vertex];
    // Cloth caught in the body is led out between parts that cross: exact
    // contacts with one would push it deeper into the other.
    if (source.side < 0)
      on = kSeveral;
    else if (!forces[source.contact].isZero(0))
      on = on == kNone ? source.contact : kSeveral;
  }
  bool more = false;
  for (const int k : loaded) {
    if (k < 0) continue;
    Contact& c = sub->contacts[k];
    if (sub->dt * c.compliance * forces[k].norm() <= kMostYield) continue;
    c.compliance = 0;
    more = true;
  }
  stats->yield_solves += more;
  return more;
}

void StepContacts::FindOnCloth(SubstepRecord* sub, StepStats* stats) {
  cloth_->Detect(
      sub->dt, sub->start.x, sub->start.v, &sub->contacts, &sub->cloth_sources);
  stats->most_crossings = std::max(stats->most_crossings, cloth_->crossings());
}

bool StepContacts::Sweep(int round, SubstepRecord* sub, StepStats* stats) {
  const Stopwatch watch;
  const VectorXd& v = sub->linearizations.back().v;
  const Points x1 = sub->start.x + sub->dt * Eigen::Map<const Points>(
                                                 v.data(), 3, v.size() / 3);
  bool again = false;
  if (round < kSweeps) {
    again = cloth_->Sweep(x1, &sub->contacts, &sub->cloth_sources) > 0;
    stats->sweep_solves += again;
  } else {
    sub->kept = cloth_->Stop(x1);
    const auto stopped = (sub->kept.array() < 1).count();
    stats->stopped += static_cast<int>(stopped);
    if (stopped == 0) sub->kept.resize(0);
  }
  stats->detection_seconds += watch.seconds();
  return again;
}

}  // namespace invsim
