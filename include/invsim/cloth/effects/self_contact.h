// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CLOTH_EFFECTS_SELF_CONTACT_H_
#define INVSIM_CLOTH_EFFECTS_SELF_CONTACT_H_

// Contact of the cloth with itself as an entry in a scene's list of effects. It
// exerts no force by itself: its contacts belong to the frictional problem of
// the step, which has them (contact/cloth_contact.h) if, and only if, a scene
// lists "self_contact". Without it layers pass through each other.

#include "invsim/base/options.h"
#include "invsim/cloth/effect.h"
#include "invsim/cloth/garment.h"

namespace invsim {

struct SelfContactOptions {
  double thickness = 0.001;  // h, m
  double friction = 0.3;     // mu
  double margin = 0.001;     // how far beyond h contacts are sought, m
  // At most, of layers that are nearer than h, m/s.
  double recovery_speed = 0.1;
  // In units of dt/m, as contact.shared_compliance.
  double compliance = 0.001;
};
void Describe(OptionTable* table, SelfContactOptions* options);

class SelfContact : public Effect {
 public:
  static constexpr char kName[] = "self_contact";

  SelfContact(const Garment& garment, const SelfContactOptions& options)
      : options_(options), made_(garment.placed) {}

  const SelfContactOptions& options() const { return options_; }
  // Positions in which the garment was made: parts next to each other are kept
  // apart by half their distance there at most.
  const Points& made() const { return made_; }

  std::string name() const override { return kName; }
  bool conservative() const override { return true; }
  bool stiffness_is_approximate() const override { return false; }

  void AddStencils(BlockPatternBuilder* builder) const override {}
  void Bind(const BlockPattern& pattern) override {}
  double Energy(const ClothState& y) const override { return 0.0; }
  void AddForce(const ClothState& y, Points* force) const override {}
  void AddStiffness(const ClothState& y,
                    double x_scale,
                    double v_scale,
                    BlockMatrix* a) const override {}
  void AddTangent(const ClothState& y,
                  const Points& dx,
                  const Points& dv,
                  double scale,
                  BlockMatrix* h_x,
                  BlockMatrix* h_v) const override {}

 private:
  SelfContactOptions options_;
  Points made_;
};

}  // namespace invsim

#endif  // INVSIM_CLOTH_EFFECTS_SELF_CONTACT_H_
