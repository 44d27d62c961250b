// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_FIT_CLOTH_POINTS_TERM_H_
#define INVSIM_FIT_CLOTH_POINTS_TERM_H_

// The distance between measured points and a simulated clothed body: the data
// part of the paper's objective (eq. 5). At every point of the search the
// whole sequence is simulated once.
//
//   cloth -> points    L_c: each cloth vertex to its nearest point
//   skin -> points     L_b: each bare body vertex to its nearest point; bare =
//                      its normal does not meet the simulated cloth
//   points -> surface  each point to the nearest of cloth and bare skin
//
// A vertex's distance is that to the plane through its point along the surface
// the points were measured on, so that sliding along it costs nothing, or, if
// asked for, to the point itself (the paper's). Each distance has a robust loss
// of its own. Costs are in units of information: all points of a frame together
// weigh as `observations` independent measurements of standard deviation
// `noise`.
//
// Which part of the cloth's past its derivative knows is `History`; what is
// left out is left out of derivatives only, never of the cost.

#include <memory>
#include <vector>

#include "invsim/base/interrupt.h"
#include "invsim/body/body_model.h"
#include "invsim/fit/cloth_rollout.h"
#include "invsim/fit/data_term.h"
#include "invsim/fit/loss.h"

namespace invsim {

enum class History {
  // The paper's: d(cloth_t) is by the body at t alone, cloth_{t-1} held.
  kOneFrame,
  // d(cloth_t) by parameters that moved alike in all frames up to t: exact for
  // the shape, and for pose and translation the answer to a lasting change
  // instead of one of a single frame.
  kCarried
};

enum class VertexDistance { kPoint, kPlane };

struct ClothPointsOptions {
  double noise = 0.01;         // m
  double observations = 1000;  // per frame
  LossOptions loss{"cauchy", 0.03};
  double cloth_to_points = 0.3;
  double skin_to_points = 0.3;
  double points_to_surface = 1;
  VertexDistance distance = VertexDistance::kPlane;
  LeadOptions lead;
  History history = History::kOneFrame;
};
void Describe(OptionTable* table, ClothPointsOptions* options);

// The cost by kind of distance.
struct ClothPointsCosts {
  double cloth_to_points = 0;
  double skin_to_points = 0;
  double points_to_surface = 0;
};

struct ClothPointsStats {
  StepStats step;  // over all evaluations
  long frames = 0;
  // Swept contacts and stopped vertices of the frames differentiated, whose
  // derivative is approximate (sim/sensitivity.h).
  long fixed_contacts = 0;
  long neighbour_queries = 0;  // of points for surfaces, and of vertices
  double simulation_seconds = 0;
  double neighbour_seconds = 0;
  double sensitivity_seconds = 0;
  double block_seconds = 0;  // the cost of the residuals found
};

class ClothPointsTerm : public DataTerm {
 public:
  ClothPointsTerm(const BodyModel& body,
                  Simulator* simulator,
                  const Faces& cloth_faces,
                  const VectorXd& cloth_areas,
                  const std::vector<Points>& clouds,
                  double frames_per_second,
                  const ClothReference& reference,
                  const ClothPointsOptions& options);
  ~ClothPointsTerm() override;

  int num_frames() const override;
  // kStopped when InterruptRequested(), or as set_stop's predicate says.
  Evaluation Evaluate(const BodySequence& x,
                      double cost_limit,
                      std::vector<double>* costs) override;
  bool Linearize(std::vector<FrameBlock>* blocks) override;

  // Asked before every frame of an evaluation.
  void set_stop(StopPredicate stop);
  // From now on the cloth of the first frame is led from there.
  void set_reference(const ClothReference& reference);

  // The simulation of the point evaluated last.
  ClothRollout& rollout();
  const ClothRollout& rollout() const;
  // The cost of the point evaluated last, by kind.
  ClothPointsCosts costs() const;
  ClothPointsStats stats() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace invsim

#endif  // INVSIM_FIT_CLOTH_POINTS_TERM_H_
