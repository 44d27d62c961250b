// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_IO_INPUT_FRAME_H_
#define INVSIM_IO_INPUT_FRAME_H_

// Inside, everything is in metres with y up and the body facing +z. Scanners
// and motion archives also use centimetres and millimetres, and z up with the
// body facing -y. A wrong scale or axis is the first cause of failed fits, so
// both are stated by the user or guessed and shown.
//
//   x_inside = scale R x_input,   R = 1 or, for z up, (x, y, z) -> (x, z, -y)

#include <string>
#include <vector>

#include "invsim/base/options.h"
#include "invsim/base/types.h"

namespace invsim {

enum class LengthUnit { kMetre, kCentimetre, kMillimetre };
enum class UpAxis { kY, kZ };

// "m", "cm" or "mm"; "y" or "z".
const char* Name(LengthUnit unit);
const char* Name(UpAxis up);

struct InputFrame {
  LengthUnit unit = LengthUnit::kMetre;
  UpAxis up = UpAxis::kY;
};

// Keys units (m, cm, mm) and up (y, z).
void Describe(OptionTable* table, InputFrame* frame);

// Metres in one unit: 1, 0.01 or 0.001.
double MetresPer(LengthUnit unit);

Points InsideFromInput(const InputFrame& frame, const Points& points);
// The way back, so that results can be written in the frame of the input.
Points InputFromInside(const InputFrame& frame, const Points& points);

struct InputFrameGuess {
  InputFrame frame;
  double height = 0;  // metres, along the guessed up axis
  // One line each, empty if nothing is odd: not metres, not y up, both axes
  // possible, not the height of a person (1.0 to 2.3 m).
  std::vector<std::string> warnings;
};

// From the bounding box of points on a person (at least one, finite): up is
// the longer of y and z; the unit is the one that brings the height nearest to
// 1.7 m in ratio. A person lying down, or a close-up of a part, is guessed
// wrong: the warnings say what to look at.
InputFrameGuess GuessInputFrame(const Points& points);

}  // namespace invsim

#endif  // INVSIM_IO_INPUT_FRAME_H_
