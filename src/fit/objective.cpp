// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/objective.h"

#include <ceres/evaluation_callback.h>
#include <ceres/loss_function.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/sized_cost_function.h>

#include <cmath>
#include <limits>

#include "prior_costs.h"

namespace invsim {

void ObjectiveCounts::Add(const ObjectiveCounts& other) {
  evaluations += other.evaluations;
  linearizations += other.linearizations;
  abandoned += other.abandoned;
  failed += other.failed;
  no_derivative += other.no_derivative;
}
namespace {

// What the data term said about the current point.
struct DataState {
  bool usable = false;
  bool linearized = false;
  std::vector<double> costs;
  std::vector<FrameBlock> blocks;
};

// A frame's compressed block. Its residuals carry gradient and curvature; the
// rest of the cost is added by the loss of the same block. If only the cost is
// known the residuals are zero and all of it is the rest.
class FrameCost
    : public ceres::
          SizedCostFunction<kNumBodyParameters, kNumShape, kNumPose, 3> {
 public:
  FrameCost(const DataState* data, int frame) : data_(data), frame_(frame) {}
  bool Evaluate(double const* const*,
                double* residuals,
                double** jacobians) const override {
    if (!data_->usable) return false;
    Eigen::Map<VectorXd> r(residuals, kNumBodyParameters);
    if (!data_->linearized) {
      r.setZero();
      return jacobians == nullptr;
    }
    const FrameBlock& block = data_->blocks[frame_];
    r = block.residual;
    constexpr int kFirst[3] = {0, kNumShape, kNumShape + kNumPose};
    constexpr int kSize[3] = {kNumShape, kNumPose, 3};
    for (int b = 0; jacobians && b < 3; ++b) {
      if (!jacobians[b]) continue;
      Eigen::Map<VertexRows>(jacobians[b], kNumBodyParameters, kSize[b]) =
          block.jacobian.middleCols(kFirst[b], kSize[b]);
    }
    return true;
  }

 private:
  const DataState* data_;
  int frame_;
};

class AddOffset : public ceres::LossFunction {
 public:
  AddOffset(const DataState* data, int frame) : data_(data), frame_(frame) {}
  void Evaluate(double squared_norm, double rho[3]) const override {
    const double offset = data_->linearized ? data_->blocks[frame_].offset()
                                            : 2 * data_->costs[frame_];
    rho[0] = squared_norm + offset;
    rho[1] = 1;
    rho[2] = 0;
  }

 private:
  const DataState* data_;
  int frame_;
};

bool SamePoint(const BodySequence& a, const BodySequence& b) {
  return a.shape == b.shape && a.poses == b.poses &&
         a.translations == b.translations;
}

std::vector<int> FixedAngles(const FreeParameters& free) {
  std::vector<int> fixed;
  for (int i = 0; i < kNumPose; ++i)
    if (!free.joints[i / 3]) fixed.push_back(i);
  return fixed;
}

}  // namespace

struct Objective::Impl : public ceres::EvaluationCallback {
  Impl(const PriorOptions& prior_options,
       const FreeParameters& free_parameters,
       DataTerm* data_term,
       BodySequence* at,
       const BodyModel& model)
      : priors(prior_options),
        free(free_parameters),
        term(data_term),
        x(at),
        body(model) {
    if (priors.overlap > 0) overlap = std::make_unique<BodyOverlap>(body);
    ceres::Problem::Options options;
    options.evaluation_callback = this;
    problem = std::make_unique<ceres::Problem>(options);
  }

  void AddParameters();
  void AddData();
  void AddPriors();
  void AddOverlap();
  void PrepareForEvaluation(bool jacobians, bool new_point) override;
  void EvaluateTerm();

  PriorOptions priors;
  FreeParameters free;
  DataTerm* term;  // null: priors alone
  BodySequence* x;
  const BodyModel& body;
  std::unique_ptr<BodyOverlap> overlap;  // null: not looked at
  DataState data;
  double cost_limit = std::numeric_limits<double>::infinity();
  BodySequence evaluated;  // where `data` is
  ObjectiveCounts counts;
  std::unique_ptr<ceres::Problem> problem;
  // Ceres lists its blocks by their addresses; gradients follow this list.
  std::vector<double*> blocks;
};

void Objective::Impl::AddParameters() {
  const auto add = [this](double* block, int size, bool moves) {
    problem->AddParameterBlock(block, size);
    if (moves)
      blocks.push_back(block);
    else
      problem->SetParameterBlockConstant(block);
  };
  const std::vector<int> fixed = FixedAngles(free);
  add(x->shape.data(), kNumShape, free.shape);
  for (int t = 0; t < x->num_frames(); ++t) {
    double* pose = x->poses[t].data();
    add(pose, kNumPose, fixed.size() < kNumPose);
    if (!fixed.empty() && fixed.size() < kNumPose)
      problem->SetManifold(pose, new ceres::SubsetManifold(kNumPose, fixed));
    add(x->translations[t].data(), 3, free.translation);
  }
}

void Objective::Impl::AddData() {
  if (!term) return;
  data.costs.resize(x->num_frames());
  data.blocks.resize(x->num_frames());
  for (int t = 0; t < x->num_frames(); ++t)
    problem->AddResidualBlock(new FrameCost(&data, t),
                              new AddOffset(&data, t),
                              x->shape.data(),
                              x->poses[t].data(),
                              x->translations[t].data());
}

void Objective::Impl::AddPriors() {
  if (priors.shape > 0)
    problem->AddResidualBlock(
        NewShapePrior(std::sqrt(priors.shape)), nullptr, x->shape.data());
  for (int t = 0; priors.pose > 0 && t < x->num_frames(); ++t)
    problem->AddResidualBlock(
        NewPosePrior(std::sqrt(priors.pose)), nullptr, x->poses[t].data());
  if (!(priors.smoothness > 0)) return;
  const double weight = std::sqrt(priors.smoothness);
  for (int t = 1; t + 1 < x->num_frames(); ++t) {
    problem->AddResidualBlock(NewRotationSmoothness(weight / priors.turn),
                              nullptr,
                              x->poses[t - 1].data(),
                              x->poses[t].data(),
                              x->poses[t + 1].data());
    problem->AddResidualBlock(NewTranslationSmoothness(weight / priors.shift),
                              nullptr,
                              x->translations[t - 1].data(),
                              x->translations[t].data(),
                              x->translations[t + 1].data());
  }
}

void Objective::Impl::AddOverlap() {
  if (!overlap || overlap->pairs().empty()) return;
  const double scale = std::sqrt(priors.overlap) / priors.depth;
  for (PoseVector& pose : x->poses)
    problem->AddResidualBlock(NewOverlapCost(scale, &body, overlap.get()),
                              nullptr,
                              x->shape.data(),
                              pose.data());
}

void Objective::Impl::EvaluateTerm() {
  if (!term) return;
  // Covariances and gradients are asked for where the optimiser just was.
  if (data.usable && SamePoint(*x, evaluated)) return;
  evaluated = *x;
  ++counts.evaluations;
  const Evaluation outcome = term->Evaluate(*x, cost_limit, &data.costs);
  data.usable = outcome == Evaluation::kDone;
  data.linearized = false;
  if (outcome == Evaluation::kAbandoned) ++counts.abandoned;
  if (outcome == Evaluation::kFailed) ++counts.failed;
}

void Objective::Impl::PrepareForEvaluation(bool jacobians, bool new_point) {
  if (new_point) EvaluateTerm();
  if (!jacobians || !data.usable || data.linearized) return;
  ++counts.linearizations;
  data.linearized = term->Linearize(&data.blocks);
  if (!data.linearized) {
    data.usable = false;
    ++counts.failed;
    ++counts.no_derivative;
  }
}

Objective::Objective(const PriorOptions& priors,
                     const FreeParameters& free,
                     DataTerm* data,
                     BodySequence* x,
                     const BodyModel& body)
    : impl_(std::make_unique<Impl>(priors, free, data, x, body)) {
  impl_->AddParameters();
  impl_->AddData();
  impl_->AddPriors();
  impl_->AddOverlap();
}

Objective::~Objective() = default;

std::unique_ptr<Objective> Objective::WithoutData() const {
  return std::make_unique<Objective>(
      impl_->priors, impl_->free, nullptr, impl_->x, impl_->body);
}

ceres::Problem* Objective::problem() { return impl_->problem.get(); }
const std::vector<double*>& Objective::blocks() const { return impl_->blocks; }
BodySequence* Objective::x() { return impl_->x; }
void Objective::SetCostLimit(double limit) { impl_->cost_limit = limit; }
const ObjectiveCounts& Objective::counts() const { return impl_->counts; }

bool Objective::Evaluate(double* cost, std::vector<double>* gradient) {
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = impl_->blocks;
  return impl_->problem->Evaluate(options, cost, nullptr, gradient, nullptr);
}

CostTerms Objective::terms() const {
  const PriorOptions& priors = impl_->priors;
  const BodySequence& x = *impl_->x;
  CostTerms terms;
  for (const double cost : impl_->data.costs) terms.data += cost;
  terms.shape = 0.5 * priors.shape * x.shape.squaredNorm();
  for (const PoseVector& pose : x.poses)
    terms.pose += 0.5 * priors.pose * PosePrior(pose, nullptr).squaredNorm();
  for (int t = 0; impl_->overlap && t < x.num_frames(); ++t)
    terms.overlap +=
        0.5 * priors.overlap / (priors.depth * priors.depth) *
        impl_->overlap->Depths(impl_->body.Joints(x.Frame(t)), nullptr)
            .squaredNorm();
  const double turn = 0.5 * priors.smoothness / (priors.turn * priors.turn);
  const double shift = 0.5 * priors.smoothness / (priors.shift * priors.shift);
  for (int t = 1; t + 1 < x.num_frames(); ++t) {
    terms.smoothness +=
        turn * LaplacianOfRotations(x.poses[t - 1], x.poses[t], x.poses[t + 1])
                   .value.squaredNorm();
    terms.smoothness += shift * (x.translations[t - 1] - 2 * x.translations[t] +
                                 x.translations[t + 1])
                                    .squaredNorm();
  }
  return terms;
}

}  // namespace invsim
