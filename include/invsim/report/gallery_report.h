// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_REPORT_GALLERY_REPORT_H_
#define INVSIM_REPORT_GALLERY_REPORT_H_

// What the gallery of hard scenes and fits showed: a table for people, JSON
// for programs, one page.

#include <string>
#include <vector>

#include "invsim/study/hard_fit.h"
#include "invsim/study/hard_scene.h"

namespace invsim {

inline constexpr int kGallerySchemaVersion = 1;

struct GalleryRow {
  HardCase hard;
  HardOutcome outcome;

  bool holds() const { return outcome.broken.empty(); }
  // It does not, and that is known, as far as it goes.
  bool known() const {
    return !holds() && !hard.border.empty() && outcome.beyond.empty();
  }
};

struct GalleryFitRow {
  HardFitCase hard;
  HardFitOutcome outcome;

  bool holds() const { return outcome.broken.empty(); }
};

struct GalleryReport {
  bool derivative = true;  // was checked
  std::vector<GalleryRow> rows;
  std::vector<GalleryFitRow> fits;
};

// Every case holds, or is a known border.
bool Holds(const GalleryReport& report);

// One sentence: how many hold, how many are known borders, which fail.
std::string GalleryVerdict(const GalleryReport& report);

// A line per scene: steps that converged of all, worst residual, penetration,
// energy, derivative, time. A line per fit: how it ended, cost, evaluations and
// those that failed, error of the body, time. Below, what does not hold.
std::string GalleryText(const GalleryReport& report);

// Schema "invsim.gallery".
std::string GalleryJson(const GalleryReport& report);

std::string GalleryHtml(const GalleryReport& report);

}  // namespace invsim

#endif  // INVSIM_REPORT_GALLERY_REPORT_H_
