// SPDX-License-Identifier: Apache-2.0
#include "invsim/sim/effect_choice.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <variant>

#include "invsim/sim/scene.h"

namespace invsim {
namespace {

std::string Short(double value) {
  std::ostringstream out;
  out.precision(2);
  out << value;
  return out.str();
}

std::string Percent(double share) { return Short(100 * share) + " %"; }

struct Verdict {
  bool on;
  std::string reason;
};

// What an effect is set to in this scene.
ConfigValue OptionOf(const SceneOptions& scene,
                     const std::string& effect,
                     const std::string& key) {
  OptionTable table;
  table.AddSection(effect, scene.effect_options.at(effect).get());
  for (const OptionTable::Option& option : table.options())
    if (option.key == effect + "." + key) return option.get();
  throw std::logic_error("no option " + effect + "." + key);
}

double MeanRestEdge(const Garment& garment) {
  double sum = 0;
  for (Eigen::Index f = 0; f < garment.rest_faces.cols(); ++f)
    for (int c = 0; c < 3; ++c)
      sum += (garment.rest.col(garment.rest_faces(c, f)) -
              garment.rest.col(garment.rest_faces((c + 1) % 3, f)))
                 .norm();
  return sum / (3.0 * garment.rest_faces.cols());
}

// B, N m; of a measured fabric the largest of the table, as its hinges read it
// (a quarter of an entry is what a flexural rigidity is).
double FlexuralRigidity(const BendingModel& model) {
  if (const auto* isotropic = std::get_if<IsotropicBending>(&model))
    return isotropic->stiffness;
  double most = 0;
  for (const auto& row : std::get<MeasuredBending>(model).table)
    for (const double k : row) most = std::max(most, k);
  return most / 4;
}

// What a scene is measured by, and a rule per effect.
class Rules {
 public:
  Rules(const SceneOptions& scene,
        const Garment& garment,
        const Material& material,
        const SceneMotion& motion)
      : scene_(scene),
        garment_(garment),
        material_(material),
        motion_(motion),
        speed_(scene.contact.friction > 0 ? motion.speed
                                          : SceneMotion::kUnknown),
        gravity_(Vector("gravity", "acceleration").norm()),
        weight_(material.density * gravity_),
        damping_(Number("mass_damping", "rate")) {}

  Verdict Decide(const std::string& effect) const {
    if (effect == "gravity") return Gravity();
    if (effect == "membrane") return {true, "without it the cloth has no size"};
    if (effect == "bending") return Bending();
    if (effect == "inertia") return Inertia();
    if (effect == "mass_damping") return MassDamping();
    if (effect == "air_drag") return AirDrag();
    if (effect == "stiffness_damping") return StiffnessDamping();
    if (effect == "self_contact") return SelfContact();
    return {true, "there is no rule by which to leave it out"};
  }

 private:
  double Number(const std::string& effect, const std::string& key) const {
    return std::get<double>(OptionOf(scene_, effect, key));
  }
  Vector3d Vector(const std::string& effect, const std::string& key) const {
    const auto list =
        std::get<std::vector<double>>(OptionOf(scene_, effect, key));
    return {list[0], list[1], list[2]};
  }

  // `share` of the weight, of something described in words.
  Verdict ByShare(double share, const std::string& what) const {
    if (gravity_ == 0)
      return {true, what + "; there is no weight to compare that with"};
    if (!std::isfinite(share)) return {true, what};
    return {share >= kNegligible,
            what + ": " + Percent(share) + " of the cloth's weight"};
  }
  std::string AtSpeed(double speed) const {
    return std::isfinite(speed) ? "at up to " + Short(speed) + " m/s"
                                : "at a speed that is not known";
  }

  Verdict Gravity() const {
    if (gravity_ == 0) return {false, "its acceleration is zero"};
    return {true, Short(gravity_) + " m/s2"};
  }

  Verdict Bending() const {
    const double b = FlexuralRigidity(material_.bending);
    const double edge = MeanRestEdge(garment_);
    const double share = b / (weight_ * edge * edge * edge);
    return ByShare(share,
                   "flexural rigidity " + Short(1e6 * b) +
                       " uN m on edges of " + Short(1000 * edge) + " mm");
  }

  // How far loose cloth falls in one step if only mass damping resists.
  double FallPerStep() const {
    const double rate = motion_.frames_per_second * scene_.step.substeps;
    const double slowest = std::min(rate, motion_.steps_per_second);
    return slowest > 0 && damping_ > 0 ? gravity_ / damping_ / slowest
                                       : SceneMotion::kUnknown;
  }

  Verdict Inertia() const {
    const bool dressing = motion_.dressing_acceleration > motion_.acceleration;
    const double a =
        std::max(motion_.acceleration, motion_.dressing_acceleration);
    if (!std::isfinite(a))
      return {true, "how fast the body changes speed is not known"};
    Verdict verdict =
        ByShare(a / gravity_,
                std::string(dressing ? "dressing" : "the motion") +
                    " accelerates the cloth at up to " + Short(a) + " m/s2");
    if (verdict.on) return verdict;
    const double fall = FallPerStep();
    if (fall < scene_.contact.margin) return verdict;
    return {true,
            "nothing else holds loose cloth: mass damping (" + Short(damping_) +
                " per s) lets it fall through more than " +
                Short(1000 * scene_.contact.margin) + " mm in a step"};
  }

  Verdict MassDamping() const {
    if (damping_ == 0) return {false, "its rate is zero"};
    if (!Inertia().on)
      return {true, "holds loose cloth in the place of inertia"};
    const double u = speed_;
    return ByShare(u * damping_ / gravity_,
                   Short(damping_) + " per s " + AtSpeed(u));
  }

  Verdict AirDrag() const {
    const double u = speed_ + Vector("air_drag", "wind").norm();
    const double density = Number("air_drag", "air_density");
    const double quadratic = 0.5 * density *
                             std::max(Number("air_drag", "normal"),
                                      Number("air_drag", "tangential"));
    const double linear = std::max(Number("air_drag", "linear_normal"),
                                   Number("air_drag", "linear_tangential"));
    if (quadratic == 0 && linear == 0)
      return {false, "its coefficients are zero"};
    return ByShare((quadratic * u + linear) * u / weight_,
                   "against the air " + AtSpeed(u));
  }

  Verdict StiffnessDamping() const {
    const double beta = std::max(Number("stiffness_damping", "membrane"),
                                 Number("stiffness_damping", "bending"));
    if (beta == 0) return {false, "its time constants are zero"};
    if (motion_.speed == 0) return {false, "the body does not move"};
    const double rate = motion_.frames_per_second * scene_.step.substeps;
    if (rate == 0) return {true, "the length of a step is not known"};
    return {beta * rate >= kLostInStep,
            Short(1000 * beta) + " ms beside the " + Short(1000 / rate) +
                " ms that the step damps with of itself"};
  }

  Verdict SelfContact() const {
    if (motion_.layers_can_meet)
      return {true, "distant parts of the garment can meet"};
    return {false, "no distant parts of the garment can meet"};
  }

  const SceneOptions& scene_;
  const Garment& garment_;
  const Material& material_;
  const SceneMotion& motion_;
  const double speed_;    // of the cloth, m/s
  const double gravity_;  // m/s^2
  const double weight_;   // N/m^2
  const double damping_;  // 1/s
};

EffectDecision Friction(const SceneOptions& options) {
  const double mu = options.contact.friction;
  return {"friction",
          mu > 0,
          "coefficient " + Short(mu) + " of cloth on body",
          true};
}

EffectDecision MeasuredFabric(const Material& material) {
  const bool stretch =
      std::holds_alternative<MeasuredStretch>(material.stretch);
  const bool bending =
      std::holds_alternative<MeasuredBending>(material.bending);
  return {"measured_fabric",
          stretch || bending,
          stretch || bending ? "the material has tables by direction and size"
                             : "the material's stiffness is constant",
          true};
}

}  // namespace

std::vector<EffectDecision> DecideEffects(const SceneOptions& options,
                                          const Garment& garment,
                                          const Material& material,
                                          const SceneMotion& motion) {
  const std::vector<std::string>& list = options.effects;
  const Rules rules(options, garment, material, motion);
  std::vector<EffectDecision> all;
  for (const std::string& name : Effects().names()) {
    if (list == std::vector<std::string>{kAutoEffects}) {
      const Verdict verdict = rules.Decide(name);
      all.push_back({name, verdict.on, verdict.reason});
    } else {
      const bool on = std::find(list.begin(), list.end(), name) != list.end();
      all.push_back({name, on, on ? "listed" : "not listed"});
    }
  }
  all.push_back(Friction(options));
  all.push_back(MeasuredFabric(material));
  return all;
}

double LayerThickness(const SceneOptions& options) {
  return std::max(
      options.contact.thickness,
      std::get<double>(OptionOf(options, "self_contact", "thickness")));
}

std::vector<std::string> EffectsOn(const std::vector<EffectDecision>& all) {
  std::vector<std::string> names;
  for (const EffectDecision& d : all)
    if (d.on && !d.built_in) names.push_back(d.name);
  return names;
}

std::string DecisionsText(const std::vector<EffectDecision>& all) {
  std::string text;
  for (const EffectDecision& d : all) {
    std::string name = d.name;
    name.resize(std::max<size_t>(name.size() + 1, 20), ' ');
    text += "  " + name + (d.on ? "on   " : "off  ") + d.reason + "\n";
  }
  return text;
}

}  // namespace invsim
