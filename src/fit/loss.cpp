// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/loss.h"

#include <ceres/loss_function.h>

#include <cmath>

namespace invsim {
namespace {

template <typename Loss>
std::unique_ptr<ceres::LossFunction> MakeScaled(const LossScale& options) {
  return std::make_unique<Loss>(options.scale);
}

std::unique_ptr<ceres::LossFunction> MakeTrivial(const LossScale&) {
  return std::make_unique<ceres::TrivialLoss>();
}

std::unique_ptr<ceres::LossFunction> MakeTolerant(const LossScale& options) {
  const double a = options.scale * options.scale;
  return std::make_unique<ceres::TolerantLoss>(a, a / 4);
}

LossRegistry MakeRegistry() {
  LossRegistry r("loss");
  r.Add<LossScale>("trivial", "squares", MakeTrivial);
  r.Add<LossScale>("huber",
                   "squares up to the scale, then linear",
                   MakeScaled<ceres::HuberLoss>);
  r.Add<LossScale>(
      "soft_l1", "smooth form of huber", MakeScaled<ceres::SoftLOneLoss>);
  r.Add<LossScale>("cauchy",
                   "logarithmic: far points hardly pull",
                   MakeScaled<ceres::CauchyLoss>);
  r.Add<LossScale>("arctan", "bounded", MakeScaled<ceres::ArctanLoss>);
  r.Add<LossScale>("tukey",
                   "points beyond the scale do not pull at all",
                   MakeScaled<ceres::TukeyLoss>);
  r.Add<LossScale>("tolerant",
                   "nearly nothing up to the scale, squares beyond",
                   MakeTolerant);
  return r;
}

}  // namespace

void Describe(OptionTable* table, LossScale* options) {
  table->Add(
      "scale",
      &options->scale,
      {.doc = "distance at which the loss bends", .unit = "m", .above = 0});
}

const LossRegistry& Losses() {
  static const LossRegistry registry = MakeRegistry();
  return registry;
}

void Describe(OptionTable* table, LossOptions* options) {
  table->Add("loss",
             &options->name,
             {.doc = "robust loss of one point", .choices = Losses().names()});
  table->Add(
      "scale",
      &options->scale,
      {.doc = "distance at which the loss bends", .unit = "m", .above = 0});
}

std::shared_ptr<const ceres::LossFunction> MakeLoss(
    const LossOptions& options) {
  if (!(options.scale > 0) || !std::isfinite(options.scale))
    throw UsageError("loss scale " + std::to_string(options.scale) +
                     " must be a positive number of metres");
  const auto choice = Losses().Choose(options.name);
  Config config;
  config.Set("scale", TomlText(options.scale), "loss scale");
  OptionTable table;
  choice->AddOptions(&table);
  table.Read(config);
  return choice->Make();
}

}  // namespace invsim
