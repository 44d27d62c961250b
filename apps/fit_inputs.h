// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_APPS_FIT_INPUTS_H_
#define INVSIM_APPS_FIT_INPUTS_H_

// What init, fit and compare read: point clouds, a body, a garment.

#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "inputs.h"
#include "invsim/cloth/material.h"
#include "invsim/fit/body_sequence.h"
#include "invsim/io/input_frame.h"
#include "invsim/io/point_cloud.h"
#include "invsim/io/point_filters.h"

namespace invsim {

struct FitInput {
  std::string points;  // folder
  std::string body;
  std::string garment;
  AuthoredGarmentOptions authored;
  double frames_per_second = 30;
  int first = 0;   // frame of the folder
  int frames = 0;  // 0: all
  InputFrame frame;
  PointReadOptions read;
  PointFilterOptions filter;
  int max_points = 4000;  // per frame
  std::string start;      // AMASS npz, "": found from the points
};
void Describe(OptionTable* table, FitInput* options);
void AddFitInputFlags(KeyFlags* flags);

// What of it may be paths.
std::vector<std::string> PathsOf(const FitInput& input);

struct FitData {
  std::vector<Points> clouds;  // metres, y up
  int dropped = 0;             // points that were not finite, all frames
  int filtered = 0;            // points that the filters took, all frames
  BodyModel body;
  Garment garment;
  Material material;
  std::optional<BodySequence> start;
};

// `options` says what the user set. Throws UsageError or InputError.
FitData LoadFitData(const FitInput& input,
                    const std::string& material,
                    const CommandContext& context);

}  // namespace invsim

#endif  // INVSIM_APPS_FIT_INPUTS_H_
