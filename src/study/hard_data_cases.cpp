// SPDX-License-Identifier: Apache-2.0

// Hard fits: points that are wrong in one way or another. What only a reader
// of files can meet (a missing frame, z up, a folder that cannot be written)
// is tested with the command.

#include <cmath>
#include <limits>
#include <utility>

#include "hard_fit_cases.h"
#include "invsim/base/random.h"
#include "invsim/geometry/sampling.h"

namespace invsim {
namespace {

Points Joined(const Points& a, const Points& b) {
  Points all(3, a.cols() + b.cols());
  all << a, b;
  return all;
}

// The points of the second frame replaced.
HardFit WithSecondFrame(const Points& points) {
  HardFit fit = PlainFit();
  fit.clouds[1] = points;
  return fit;
}

HardFit NotANumber() {
  HardFit fit = PlainFit();
  fit.clouds[1](2, 7) = std::numeric_limits<double>::quiet_NaN();
  return fit;
}

HardFit CloudsInMillimetres() {
  HardFit fit = PlainFit();
  fit.start.reset();
  for (Points& cloud : fit.clouds) cloud *= 1000;
  return fit;
}

HardFit UpperHalf() {
  HardFit fit = PlainFit();
  for (Points& cloud : fit.clouds) {
    std::vector<int> upper;
    for (int i = 0; i < cloud.cols(); ++i)
      if (cloud(1, i) > cloud.row(1).mean()) upper.push_back(i);
    cloud = cloud(Eigen::all, upper).eval();
  }
  MeasureFromPointsAlone(&fit);
  fit.body_error = 0.1;  // nothing says where the legs are
  return fit;
}

HardFit HalfOutliers() {
  HardFit fit = PlainFit();
  Random random(2);
  for (Points& cloud : fit.clouds)
    for (int i = 0; i < cloud.cols(); i += 2)
      for (double& x : cloud.col(i)) x += random.Uniform(-0.2, 0.2);
  fit.body_error = 0.035;
  return fit;
}

HardFit DifferentCounts() {
  HardFit fit = PlainFit();
  fit.clouds[1] = fit.clouds[1].leftCols(100).eval();
  fit.body_error = 0.02;
  return fit;
}

HardFit TwoFrames() {
  HardFit fit = PlainFit(2);
  fit.body_error = 0.02;
  return fit;
}

HardFit SomeoneElsesGarment() {
  HardFit fit = PlainFit();
  fit.garment.placed *= 0.7;
  return fit;
}

// A frame measured 2,500 times over, each time with other noise.
HardFit AMillionPoints() {
  HardFit fit = PlainFit(1);
  const Points few = fit.clouds[0];
  Points many(3, 1000000);
  Random random(6);
  for (int i = 0; i < many.cols(); ++i)
    for (int c = 0; c < 3; ++c)
      many(c, i) = few(c, i % few.cols()) + 0.002 * random.Normal();
  fit.clouds[0] = std::move(many);
  SetOption(&fit, "data.distance", "point");
  SetOption(&fit, "lm.iterations", "1");  // of ten seconds
  fit.body_error = 0.03;
  return fit;
}

// Half a metre behind the back, as many points as on the person.
HardFit WallBehind() {
  HardFit fit = PlainFit();
  Random random(8);
  for (Points& cloud : fit.clouds) {
    const Vector3d middle = cloud.rowwise().mean();
    Points wall(3, cloud.cols());
    for (int i = 0; i < wall.cols(); ++i)
      wall.col(i) =
          middle + Vector3d(random.Uniform(-1, 1), random.Uniform(-1, 1), -0.5);
    cloud = Joined(cloud, wall);
  }
  fit.body_error = 0.04;
  return fit;
}

// The same, and nothing is known of where the person is.
HardFit WallBehindAndNoStart() {
  HardFit fit = WallBehind();
  fit.start.reset();
  fit.body_error = std::numeric_limits<double>::infinity();
  return fit;
}

}  // namespace

void AddDataCases(std::vector<HardFitCase>* cases) {
  const auto add = [&](const char* name,
                       const char* shows,
                       std::function<HardFit()> make,
                       const char* refusal = "") {
    cases->push_back(
        {std::string("data/") + name, shows, std::move(make), refusal});
  };
  add(
      "no_frame",
      "no points at all",
      [] {
        HardFit fit = PlainFit();
        fit.clouds.clear();
        return fit;
      },
      "points: no frame");
  add(
      "empty_frame",
      "a frame without points",
      [] { return WithSecondFrame(Points(3, 0)); },
      "points of frame 1: none");
  add(
      "one_point",
      "a frame of one point",
      [] { return WithSecondFrame(Points::Ones(3, 1)); },
      "points of frame 1: all 1 within 0 mm; expected a person");
  add(
      "all_equal",
      "400 points in one place",
      [] { return WithSecondFrame(Points::Ones(3, 400)); },
      "points of frame 1: all 400 within 0 mm; expected a person");
  add("not_a_number",
      "a coordinate that is not a number",
      NotANumber,
      "points of frame 1: not all finite");
  add("millimetres",
      "metres by name, millimetres by size",
      CloudsInMillimetres,
      "m; expected a person, 0.3 to 5 m (wrong unit?)");
  add("other_garment",
      "a garment that is too small by a third",
      SomeoneElsesGarment,
      "vertices are inside the body; expected a garment placed around the "
      "T-posed body");
  add(
      "start_too_short",
      "a start of fewer frames than there are",
      [] {
        HardFit fit = PlainFit();
        fit.start->poses.pop_back();
        fit.start->translations.pop_back();
        return fit;
      },
      "the start has 2 frames, expected one per point cloud, 3");
  add("different_counts", "frames of 400, 100 and 400 points", DifferentCounts);
  add("two_frames", "fewer frames than smoothness in time needs", TwoFrames);
  add("upper_half", "nothing measured below the waist", UpperHalf);
  add("half_outliers", "every other point up to 20 cm off", HalfOutliers);
  add("million_points", "a frame of a million points", AMillionPoints);
  add("wall_behind", "as many points on a flat wall behind", WallBehind);
  add("wall_behind_no_start",
      "the same, the first body sought among them",
      WallBehindAndNoStart);
}

}  // namespace invsim
