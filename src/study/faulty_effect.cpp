// SPDX-License-Identifier: Apache-2.0
#include "faulty_effect.h"

#include <limits>
#include <utility>

namespace invsim {
namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
// More than any cloth resists with.
constexpr double kLarge = 1e9;  // N s/m

class FaultyEffect : public Effect {
 public:
  FaultyEffect(Fault fault, std::function<bool(const ClothState&)> strikes)
      : fault_(fault), strikes_(std::move(strikes)) {}

  std::string name() const override { return "fault"; }
  bool conservative() const override { return false; }
  bool stiffness_is_approximate() const override { return false; }
  void AddStencils(BlockPatternBuilder*) const override {}
  void Bind(const BlockPattern&) override {}
  double Energy(const ClothState&) const override { return 0; }

  void AddForce(const ClothState& y, Points* force) const override {
    if (Strikes(Fault::kForce, y)) (*force)(0, 0) = kNotANumber;
  }
  void AddStiffness(const ClothState& y,
                    double,
                    double,
                    BlockMatrix* a) const override {
    if (Strikes(Fault::kStiffness, y))
      a->diagonal(0).diagonal().array() -= kLarge;
  }
  void AddTangent(const ClothState& y,
                  const Points&,
                  const Points&,
                  double,
                  BlockMatrix* h_x,
                  BlockMatrix*) const override {
    if (Strikes(Fault::kTangent, y)) h_x->diagonal(0).setConstant(kNotANumber);
  }

 private:
  bool Strikes(Fault fault, const ClothState& y) const {
    return fault == fault_ && strikes_(y);
  }

  Fault fault_;
  std::function<bool(const ClothState&)> strikes_;
};

}  // namespace

std::unique_ptr<Effect> MakeFaultyEffect(
    Fault fault, std::function<bool(const ClothState&)> strikes) {
  return std::make_unique<FaultyEffect>(fault, std::move(strikes));
}

}  // namespace invsim
