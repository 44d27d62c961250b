// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/material.h"

#include <cmath>
#include <sstream>

#include "invsim/base/error.h"

namespace invsim {
namespace {

// Collects where a figure stands and throws about it.
class Checker {
 public:
  explicit Checker(const std::string& name) : name_(name) {}

  void Require(bool good,
               const std::string& field,
               double value,
               const std::string& expected) const {
    if (good && std::isfinite(value)) return;
    std::ostringstream text;
    text << name_ << ": " << field << " is " << value << ", expected "
         << expected;
    throw InputError(text.str());
  }

  void operator()(const IsotropicStretch& s) const {
    Require(s.stiffness > 0.0,
            "stretch stiffness",
            s.stiffness,
            "a positive number of N/m");
    Require(s.poisson > -1.0 && s.poisson < 1.0,
            "stretch poisson",
            s.poisson,
            "between -1 and 1");
  }

  void operator()(const OrthotropicStretch& s) const {
    const std::string positive = "a positive number of N/m";
    Require(s.c11 > 0.0, "stretch c11", s.c11, positive);
    Require(s.c22 > 0.0, "stretch c22", s.c22, positive);
    Require(s.c33 > 0.0, "stretch c33", s.c33, positive);
    Require(
        s.c12 * s.c12 < s.c11 * s.c22, "stretch c12", s.c12, "c12^2 < c11 c22");
  }

  // Negative entries occur in published tables; the law sets them to zero.
  void operator()(const MeasuredStretch& s) const {
    for (int i = 0; i < 6; ++i)
      for (int k = 0; k < 4; ++k)
        Require(
            std::abs(s.table[i][k]) < 1e6,
            "stretching[" + std::to_string(i) + "][" + std::to_string(k) + "]",
            s.table[i][k],
            "a number of N/m below 1e6");
  }

  void operator()(const IsotropicBending& b) const {
    Require(b.stiffness >= 0.0,
            "bending stiffness",
            b.stiffness,
            "a number of N m, at least 0");
  }

  void operator()(const MeasuredBending& b) const {
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 5; ++k)
        Require(std::abs(b.table[i][k]) < 1.0,
                "bending[" + std::to_string(i) + "][" + std::to_string(k) + "]",
                b.table[i][k],
                "a number of N m below 1");
  }

 private:
  std::string name_;
};

}  // namespace

OrthotropicStretch FromEngineeringConstants(double stiffness_1,
                                            double stiffness_2,
                                            double shear,
                                            double poisson_12) {
  const double poisson_21 = poisson_12 * stiffness_2 / stiffness_1;
  const double scale = 1.0 / (1.0 - poisson_12 * poisson_21);
  return {.c11 = scale * stiffness_1,
          .c12 = scale * poisson_12 * stiffness_2,
          .c22 = scale * stiffness_2,
          .c33 = shear};
}

void ValidateMaterial(const Material& material, const std::string& name) {
  const Checker check(name);
  check.Require(material.density > 0.0,
                "density",
                material.density,
                "a positive number of kg/m^2");
  check.Require(material.friction >= 0.0,
                "friction",
                material.friction,
                "a number, at least 0");
  std::visit(check, material.stretch);
  std::visit(check, material.bending);
}

}  // namespace invsim
