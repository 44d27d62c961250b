// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_REPORT_SOAK_REPORT_H_
#define INVSIM_REPORT_SOAK_REPORT_H_

// What a soak showed: a table for people, JSON for programs.

#include <string>

#include "invsim/study/soak.h"

namespace invsim {

inline constexpr int kSoakSchemaVersion = 1;

// One figure per line; below, by limit, how many scenes broke it and which
// seeds, and the first scenes in words.
std::string SoakText(const SoakResult& result);

// Schema "invsim.soak": the same, with every failing scene.
std::string SoakJson(const SoakResult& result);

}  // namespace invsim

#endif  // INVSIM_REPORT_SOAK_REPORT_H_
