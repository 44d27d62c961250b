// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_FIT_BODY_POINTS_TERM_H_
#define INVSIM_FIT_BODY_POINTS_TERM_H_

// The distance between a bare body and the points of clothed frames (the
// paper's eq. 7, without a simulated garment), both ways:
//
//   point -> body   d = signed distance of a point to the skin. Where the
//                   garment leaves the nearest skin bare the point lies on it:
//                   rho(d^2). Elsewhere the point lies on cloth, and cloth is
//                   outside: d^2 inside the body, outside only a weak pull,
//                   so that the garment does not inflate the body. Between
//                   bare and hidden vertices the two are blended; that the
//                   blend changes as the nearest point slides over the skin is
//                   left out of the derivative, and of nothing else.
//   skin -> point   every bare vertex of the body to its nearest point:
//                   rho(|m_i - p|^2), so that no limb is left in the air.
//
// Costs are in units of information: all points of a frame together weigh as
// `observations` independent measurements of standard deviation `noise`.

#include <memory>
#include <vector>

#include "invsim/body/body_model.h"
#include "invsim/fit/data_term.h"
#include "invsim/fit/loss.h"
#include "invsim/geometry/kd_tree.h"

namespace invsim {

struct BodyPointsOptions {
  double noise = 0.01;         // m
  double observations = 1000;  // per frame
  LossOptions skin{"cauchy", 0.03};
  // Pull of points outside covered skin, as a share of that of skin.
  double cloth_pull = 0.1;
  LossOptions cloth{"cauchy", 0.02};
  // Weight of the direction skin -> points.
  double skin_to_points = 0.3;
  int max_vertices = 3000;  // of the body, in that direction
};
void Describe(OptionTable* table, BodyPointsOptions* options);

class BodyPointsTerm : public DataTerm {
 public:
  // `covered`: per vertex whether the garment hides it. One cloud per frame,
  // none empty. `seed` chooses the vertices if there are too many.
  BodyPointsTerm(const BodyModel& body,
                 const std::vector<bool>& covered,
                 const std::vector<Points>& clouds,
                 const BodyPointsOptions& options,
                 std::uint64_t seed);
  ~BodyPointsTerm() override;

  int num_frames() const override;
  Evaluation Evaluate(const BodySequence& x,
                      double cost_limit,
                      std::vector<double>* costs) override;
  bool Linearize(std::vector<FrameBlock>* blocks) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace invsim

#endif  // INVSIM_FIT_BODY_POINTS_TERM_H_
