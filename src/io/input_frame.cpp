// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/input_frame.h"

#include <cmath>
#include <cstdio>
#include <limits>

namespace invsim {
namespace {

// (x, y, z) -> (x, z, -y) takes z up, facing -y to y up, facing +z.
Matrix3d InsideFromInputAxes(UpAxis up) {
  if (up == UpAxis::kY) return Matrix3d::Identity();
  return (Matrix3d() << 1, 0, 0, 0, 0, 1, 0, -1, 0).finished();
}

std::string Digits(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g", value);
  return text;
}

LengthUnit NearestUnit(double height) {
  constexpr double kPerson = 1.7;
  LengthUnit nearest = LengthUnit::kMetre;
  double smallest = std::numeric_limits<double>::infinity();
  for (LengthUnit unit :
       {LengthUnit::kMetre, LengthUnit::kCentimetre, LengthUnit::kMillimetre}) {
    const double distance =
        std::abs(std::log(MetresPer(unit) * height / kPerson));
    if (distance < smallest) {
      smallest = distance;
      nearest = unit;
    }
  }
  return nearest;
}

}  // namespace

const char* Name(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::kMetre:
      return "m";
    case LengthUnit::kCentimetre:
      return "cm";
    default:
      return "mm";
  }
}

const char* Name(UpAxis up) { return up == UpAxis::kY ? "y" : "z"; }

void Describe(OptionTable* table, InputFrame* frame) {
  table->Add("units",
             &frame->unit,
             {{"m", LengthUnit::kMetre},
              {"cm", LengthUnit::kCentimetre},
              {"mm", LengthUnit::kMillimetre}},
             {.doc = "unit of length of the input"});
  table->Add("up",
             &frame->up,
             {{"y", UpAxis::kY}, {"z", UpAxis::kZ}},
             {.doc = "axis that points up in the input; a body faces +z if it "
                     "is y, -y if it is z"});
}

double MetresPer(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::kMetre:
      return 1;
    case LengthUnit::kCentimetre:
      return 0.01;
    default:
      return 0.001;
  }
}

Points InsideFromInput(const InputFrame& frame, const Points& points) {
  return MetresPer(frame.unit) * InsideFromInputAxes(frame.up) * points;
}

Points InputFromInside(const InputFrame& frame, const Points& points) {
  return InsideFromInputAxes(frame.up).transpose() * points /
         MetresPer(frame.unit);
}

InputFrameGuess GuessInputFrame(const Points& points) {
  const Vector3d extent =
      points.rowwise().maxCoeff() - points.rowwise().minCoeff();
  InputFrameGuess guess;
  guess.frame.up = extent.z() > extent.y() ? UpAxis::kZ : UpAxis::kY;
  const double height = std::max(extent.y(), extent.z());
  const double other = std::min(extent.y(), extent.z());
  guess.frame.unit = NearestUnit(height);
  guess.height = MetresPer(guess.frame.unit) * height;

  if (guess.frame.unit != LengthUnit::kMetre) {
    guess.warnings.push_back("the extent " + Digits(height) + " looks like " +
                             Name(guess.frame.unit) + ", not metres");
  }
  if (other >= 0.8 * height) {
    guess.warnings.push_back("the extents along y (" + Digits(extent.y()) +
                             ") and z (" + Digits(extent.z()) +
                             ") are alike: either may be up");
  } else if (guess.frame.up == UpAxis::kZ) {
    guess.warnings.push_back("z looks like the up axis, not y");
  }
  if (guess.height < 1.0 || guess.height > 2.3) {
    guess.warnings.push_back("a height of " + Digits(guess.height) +
                             " m is not a person's: expected 1.0 to 2.3 m");
  }
  return guess;
}

}  // namespace invsim
